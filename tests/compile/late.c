/* First the header alone, as another header would include it, then the implementation. */
#include "../../rt.h"

#define RT_IMPLEMENTATION
#include "../../rt.h"

int main(void)
{
    return rt_status_text(RT_OK) == 0;
}

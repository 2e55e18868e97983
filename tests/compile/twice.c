/* Included twice, the implementation too. */
#define RT_IMPLEMENTATION
#include "../../rt.h"
#include "../../rt.h"

int main(void)
{
    return rt_status_text(RT_OK) == 0;
}

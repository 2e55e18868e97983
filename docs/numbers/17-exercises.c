#define RT_IMPLEMENTATION
#include "demos/shapes.h"
#include "measure.h"
#include <stdio.h>
int main(void)
{
    static const cylinder c = {{0, 0, 0}, 2, 3};
    const rt_custom_shape s = {
        {-2, 0, -2}, {2, 3, 2}, {{0, 0, 0}, false}, cylinder_hit, &c};
    printf("cylinder: %.4f\n", volume_of(&s));
}

/* Chapter 18: answers of the exercises. */
#define main job
#include "../machines/job.c"
#undef main

/* How many rays the parts of job.c have, all together. */
static unsigned long long rays_of(int parts)
{
    static rt_vec3 pixels[640 * 480];
    const rt_camera camera = {.fov_y = 60};
    unsigned long long rays = 0;
    for (int k = 1; k <= parts; k++) {
        rt_image part = {640, 480, pixels};
        part.first = (int)(640LL * 480 * (k - 1) / parts);
        part.count = (int)(640LL * 480 * k / parts) - part.first;
        if (rt_render(&scene, &camera, &(rt_options){.bounces = 5}, &part) != RT_OK)
            return 0;
        rays += part.rays;
    }
    return rays;
}

int main(void)
{
    printf("cut:");
    for (int k = 1; k <= 7; k++)
        printf(" %d%s", 12 * k / 7 - 12 * (k - 1) / 7, k < 7 ? "," : "\n");
    printf("parts: %llu\nrays: %llu\n", rays_of(60), rays_of(1));
}

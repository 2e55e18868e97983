/* Chapter 18: eight machines render the scene of job.c under a sky, in 64 parts; a part takes as
 * long as it has rays. */
#define main job
#include "../machines/job.c"
#undef main

enum {
    MACHINES = 8,
    COLUMNS = 320,
    ROWS = 240,
    PARTS = 64,
    SIZE = ROWS * COLUMNS / PARTS
};

typedef struct shares {
    rt_vec3 pixels[ROWS * COLUMNS];
    uint64_t rays[PARTS];
    int fixed[PARTS], counted[PARTS]; /* which machine gets the part */
} shares;

static rt_status render_parts(const rt_options *options, shares *s)
{
    const rt_camera camera = {.fov_y = 60};
    rt_scene outdoors = scene;
    outdoors.background = (rt_vec3){0.5f, 0.6f, 0.7f};
    uint64_t busy[MACHINES] = {0};
    for (int k = 0; k < PARTS; k++) {
        rt_image part = {COLUMNS, ROWS, s->pixels + k * SIZE};
        part.first = k * SIZE;
        part.count = SIZE;
        const rt_status status = rt_render(&outdoors, &camera, options, &part);
        if (status != RT_OK)
            return status;
        s->rays[k] = part.rays;
        int free = 0; /* the machine that is ready first takes the next */
        for (int m = 1; m < MACHINES; m++)
            free = busy[m] < busy[free] ? m : free;
        busy[free] += part.rays;
        s->counted[k] = free;
        s->fixed[k] = k * MACHINES / PARTS;
    }
    return RT_OK;
}

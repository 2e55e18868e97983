/* Demo 07: indirect light, by Monte Carlo.
 *
 * Before  light comes from the lamp only, and shadows are black.
 * Now     every surface lights every other. At each hit ONE random direction is followed,
 *         up to 5 times, and each pixel takes the mean of many such paths. Four times as
 *         many samples make half the noise.
 * Run     make demo07                         (or ARGS="--samples 256", and wait a little) */
#include "live.h"

/* A random direction about N, drawn in proportion to its cosine with N. */
static rt_vec3 sample_cosine(rt_vec3 N, float r1, float r2)
{
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine); /* of 2 pi r1 */
    const float x = cosine * sqrtf(1.0f - r2);
    const float y = sine * sqrtf(1.0f - r2);
    const float z = sqrtf(r2);
    rt_vec3 a, b;
    rt_basis(N, &a, &b);
    return rt_add(rt_add(rt_scale(a, x), rt_scale(b, y)), rt_scale(N, z));
}

/* The light that comes back along the ray: one path, one estimate. */
static rt_vec3 radiance(const rt_scene *scene, rt_ray ray, int bounces, rt_rng *rng)
{
    rt_vec3 sum = rt_vec(0, 0, 0);
    rt_vec3 throughput = rt_vec(1, 1, 1); /* what is left of light on the way back */
    for (int bounce = 0; bounce <= bounces; bounce++) {
        rt_hit hit;
        rng->rays++;
        if (!rt_intersect(scene, &ray, &hit))
            break;
        rt_vec3 direction;
        if (hit.material->mirror) {
            direction = rt_reflect(ray.direction, hit.normal);
        } else {
            sum = rt_add(sum, rt_mul(throughput, rt_direct(scene, &hit, rng)));
            throughput = rt_mul(throughput, hit.material->albedo); /* cosine, pi cancel */
            const float r1 = rt_random(rng); /* one number per statement: the order of */
            const float r2 = rt_random(rng); /* arguments is the compiler's choice */
            direction = sample_cosine(hit.normal, r1, r2);
        }
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
    return sum;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    if (view->bounces == RT_ALL_BOUNCES) /* by roulette, as in rt.h */
        return rt_radiance(&scene_indirect, &ray, view->bounces, rng);
    return radiance(&scene_indirect, ray, view->bounces, rng);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo07",
                             .title = "7. Indirect light",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 7,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 5});
}

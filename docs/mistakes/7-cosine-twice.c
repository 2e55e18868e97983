/* The cosine twice
 *
 * Symptom: indirect light is too weak: shadows, corners, and the underside of the ball
 *          are darker
 * Cause:   directions drawn by the cosine, and a factor <N,w> as well
 * Cure:    the density already has the cosine, so it cancels
 * Options:
 */
#define rt_radiance my_radiance
#include "rt.h"

static inline rt_vec3 my_radiance(const rt_scene *scene, const rt_ray *camera_ray,
                                  int bounces, rt_rng *rng)
{
    rt_ray ray = *camera_ray;
    rt_vec3 sum = rt_vec(0, 0, 0), throughput = rt_vec(1, 1, 1);
    for (int bounce = 0; bounce <= bounces; bounce++) {
        rt_hit hit;
        rt_vec3 direction;
        if (!rt_intersect(scene, &ray, &hit))
            break;
        if (hit.material->mirror) {
            direction = rt_reflect(ray.direction, hit.normal);
        } else {
            sum = rt_add(sum, rt_mul(throughput, rt_direct(scene, &hit, rng)));
            throughput = rt_mul(throughput, hit.material->albedo);
            const float r1 = rt_random(rng);
            const float r2 = rt_random(rng);
            direction = rt_sample_cosine(hit.normal, r1, r2);
            throughput = rt_scale(throughput, rt_dot(hit.normal, direction));
        }
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
    return sum;
}

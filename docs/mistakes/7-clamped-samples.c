/* Gamma before the mean
 *
 * Symptom: smoother, greyer and darker: the bright grains are gone, and their
 *          light with them. The picture changes with the number of samples
 * Cause:   each sample was made a byte, and the bytes were averaged; but the mean of
 *          roots is not the root of the mean
 * Cure:    add up light, and encode once, at the end
 * Options:
 */
#define rt_radiance my_radiance
#define rt_encode my_encode
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
        }
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
    return rt_vec(powf(sum.x < 1 ? sum.x : 1, 1 / 2.2f),
                  powf(sum.y < 1 ? sum.y : 1, 1 / 2.2f),
                  powf(sum.z < 1 ? sum.z : 1, 1 / 2.2f));
}

static inline unsigned char my_encode(float value, double gamma)
{
    (void)gamma;
    return (unsigned char)(255 * value + 0.5f);
}

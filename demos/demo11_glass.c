/* Demo 11: glass.
 *
 * Before  a ray is sent on by a mirror, or by chance from a matt surface.
 * Now     glass reflects a part of the light, and bends the rest. The ray tosses a coin,
 *         and takes one of the two ways.
 * Run     make demo11                                        (or ARGS="--bounces 3") */
#include "live.h"

/* The part that is reflected, by Fresnel; eta is the index behind the surface over the
 * one before. */
static float fresnel(float cosine, float eta)
{
    const float sin2 = (1 - cosine) * (1 + cosine) / (eta * eta); /* Snell */
    if (!(sin2 < 1))
        return 1; /* there is no way on: total reflection */
    const float through = sqrtf(1 - sin2);
    const float p = (eta * cosine - through) / (eta * cosine + through);
    const float s = (cosine - eta * through) / (cosine + eta * through);
    return 0.5f * (p * p + s * s);
}

/* The way on behind the surface, if there is one. */
static bool refract(rt_vec3 I, rt_vec3 N, float eta, rt_vec3 *T)
{
    const float cosine = -rt_dot(I, N);
    const float sin2 = (1 - cosine) * (1 + cosine) / (eta * eta);
    if (!(sin2 < 1))
        return false;
    *T = rt_add(rt_scale(I, 1 / eta), rt_scale(N, cosine / eta - sqrtf(1 - sin2)));
    return true;
}

/* Chapter 7's loop; what happens at glass is new. */
static rt_vec3 radiance(const rt_scene *scene, rt_ray ray, int bounces, rt_rng *rng)
{
    if (bounces == RT_ALL_BOUNCES) /* by roulette, as in rt.h */
        return rt_radiance_mis(scene, &ray, bounces, rng);
    rt_vec3 sum = {0, 0, 0}, throughput = {1, 1, 1};
    for (int bounce = 0; bounce <= bounces; bounce++) {
        rt_hit hit;
        rng->rays++;
        if (!rt_intersect(scene, &ray, &hit))
            break;
        const rt_surface *surface = rt_surface_of(scene, &hit);
        rt_vec3 direction = rt_reflect(ray.direction, hit.normal);
        if (surface->eta > 0) {
            const bool inside = rt_is_inside(scene, &hit);
            const float eta = inside ? 1 / surface->eta : surface->eta;
            if (inside) /* the ray comes through the glass, which absorbs some light */
                throughput =
                    rt_mul(throughput, rt_transmittance(surface->absorption, hit.t));
            const float coin = rt_random(rng);
            rt_random(rng); /* not used: numbers come in pairs */
            if (coin >= fresnel(-rt_dot(ray.direction, hit.normal), eta))
                refract(ray.direction, hit.normal, eta, &direction);
        } else if (!hit.material->mirror) {
            sum = rt_add(sum, rt_mul(throughput, rt_direct(scene, &hit, rng)));
            throughput = rt_mul(throughput, hit.material->albedo);
            const float r1 = rt_random(rng);
            const float r2 = rt_random(rng);
            direction = rt_sample_cosine(hit.normal, r1, r2);
        }
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
    return sum;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    return radiance(&scene_glass, ray, view->bounces, rng);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo11",
                             .title = "11. Glass",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 8,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

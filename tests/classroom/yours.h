/* The student's routines where the student's file is not: in the program that marks (pupil.c), in
 * the picture (show.c, show_scene.c), in rt.h's own tests. Each is compiled by itself, so that no
 * name and no macro of one can mean anything in the other, and linked with the student's file,
 * which was compiled by itself, too, and exports a pointer to each routine that it replaces.
 *
 *     #define rt_reflect rt__its_reflect     for each of these
 *     #include "yours.h"                     in place of the student's file
 */
#ifndef YOURS_H
#define YOURS_H

#include "../../rt.h"

/* Weak: the pointers of routines that it does not replace are not there. */
#define YOURS(type, name, parameters, values)                                            \
    extern type(*const rt__yours_##name) parameters __attribute__((weak));               \
    static inline type name parameters                                                   \
    {                                                                                    \
        return rt__yours_##name values;                                                  \
    }

#ifdef rt_camera_ray
YOURS(rt_ray, rt_camera_ray,
      (const rt_camera *camera, int width, int height, float x, float y),
      (camera, width, height, x, y))
#endif
#ifdef rt_hit_sphere
YOURS(bool, rt_hit_sphere,
      (const rt_sphere *sphere, const rt_ray *ray, float t_max, rt_hit *hit),
      (sphere, ray, t_max, hit))
#endif
#ifdef rt_intersect
YOURS(bool, rt_intersect, (const rt_scene *scene, const rt_ray *ray, rt_hit *hit),
      (scene, ray, hit))
#endif
#ifdef rt_lambert
YOURS(rt_vec3, rt_lambert,
      (rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light, rt_vec3 intensity),
      (albedo, normal, to_light, intensity))
#endif
#ifdef rt_hit_box
YOURS(bool, rt_hit_box, (const rt_box *box, const rt_ray *ray, float t_max, rt_hit *hit),
      (box, ray, t_max, hit))
#endif
#ifdef rt_leave
YOURS(rt_vec3, rt_leave, (rt_vec3 point, rt_vec3 normal, rt_vec3 direction),
      (point, normal, direction))
#endif
#ifdef rt_occluded
YOURS(bool, rt_occluded, (const rt_scene *scene, const rt_ray *ray, float t_max),
      (scene, ray, t_max))
#endif
#ifdef rt_visible
YOURS(bool, rt_visible,
      (const rt_scene *scene, rt_vec3 point, rt_vec3 normal, rt_vec3 light),
      (scene, point, normal, light))
#endif
#ifdef rt_direct
YOURS(rt_vec3, rt_direct, (const rt_scene *scene, const rt_hit *hit, rt_rng *rng),
      (scene, hit, rng))
#endif
#ifdef rt_encode
YOURS(unsigned char, rt_encode, (float value, double gamma), (value, gamma))
#endif
#ifdef rt_reflect
YOURS(rt_vec3, rt_reflect, (rt_vec3 incident, rt_vec3 normal), (incident, normal))
#endif
#ifdef rt_random
YOURS(float, rt_random, (rt_rng * rng), (rng))
#endif
#ifdef rt_sample_cosine
YOURS(rt_vec3, rt_sample_cosine, (rt_vec3 normal, float r1, float r2), (normal, r1, r2))
#endif
#ifdef rt_radiance
YOURS(rt_vec3, rt_radiance,
      (const rt_scene *scene, const rt_ray *camera_ray, int bounces, rt_rng *rng),
      (scene, camera_ray, bounces, rng))
#endif
#ifdef rt_fresnel
YOURS(float, rt_fresnel, (float cosine, float eta), (cosine, eta))
#endif
#ifdef rt_refract
YOURS(bool, rt_refract, (rt_vec3 incident, rt_vec3 normal, float eta, rt_vec3 *refracted),
      (incident, normal, eta, refracted))
#endif
#ifdef rt_sample_lamp
YOURS(rt_vec3, rt_sample_lamp, (const rt_lamp *lamp, rt_vec3 point, float r1, float r2),
      (lamp, point, r1, r2))
#endif
#ifdef rt_lamp_density
YOURS(float, rt_lamp_density, (const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction),
      (lamp, point, direction))
#endif
#ifdef rt_mis
YOURS(float, rt_mis, (float density, float other), (density, other))
#endif
#ifdef rt_sample_gloss
YOURS(rt_vec3, rt_sample_gloss,
      (rt_vec3 normal, rt_vec3 to_eye, float shininess, float r1, float r2),
      (normal, to_eye, shininess, r1, r2))
#endif
#ifdef rt_gloss
YOURS(float, rt_gloss,
      (rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light, float shininess, float *density),
      (normal, to_eye, to_light, shininess, density))
#endif
#ifdef rt_lens_ray
YOURS(rt_ray, rt_lens_ray,
      (const rt_camera *camera, const rt_lens *lens, const rt_ray *pinhole, float r1,
       float r2),
      (camera, lens, pinhole, r1, r2))
#endif
#ifdef rt_hit_triangle
YOURS(bool, rt_hit_triangle,
      (const rt_mesh *mesh, int triangle, const rt_ray *ray, float t_max, rt_hit *hit),
      (mesh, triangle, ray, t_max, hit))
#endif

#endif

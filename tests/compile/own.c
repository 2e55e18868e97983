/* Routines of the user's own in place of rt.h's: rt_render calls them, and only them. */
#define rt_camera_ray my_camera_ray
#define rt_hit_sphere my_hit_sphere
#define rt_hit_box my_hit_box
#define rt_hit_triangle my_hit_triangle
#define rt_lambert my_lambert
#define rt_reflect my_reflect
#define RT_IMPLEMENTATION
#include "../../rt.h"

static int asked[6];

static inline rt_ray my_camera_ray(const rt_camera *camera, int width, int height,
                                   float x, float y)
{
    rt_ray ray;
    ray.origin = camera->position;
    ray.direction = rt_vec(x / (float)width - 0.5f, 0.5f - y / (float)height, -1);
    asked[0]++;
    return ray;
}

/* One sphere fills the right half of the view, whatever the scene says. */
static inline bool my_hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                                 rt_hit *hit)
{
    asked[1]++;
    if (!(ray->direction.x > 0 && ray->direction.z < 0 && t_max > 2))
        return false;
    hit->t = 2;
    hit->point = rt_at(ray, 2);
    hit->normal = rt_vec(0, 0, 1);
    hit->material = &sphere->material;
    return true;
}

static inline bool my_hit_box(const rt_box *box, const rt_ray *ray, float t_max,
                              rt_hit *hit)
{
    (void)box, (void)ray, (void)t_max, (void)hit;
    asked[2]++;
    return false;
}

static inline bool my_hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   float t_max, rt_hit *hit)
{
    (void)mesh, (void)triangle, (void)ray, (void)t_max, (void)hit;
    asked[5]++;
    return false;
}

static inline rt_vec3 my_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity)
{
    (void)normal, (void)to_light, (void)intensity;
    asked[3]++;
    return albedo;
}

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    (void)incident, (void)normal;
    asked[4]++;
    return rt_vec(1, 0, -1);
}

int main(void)
{
    static rt_vec3 pixels[8 * 6];
    const rt_sphere sphere = {{9, 9, 9}, 1, {{0.5f, 0.25f, 1}, false}};
    const rt_sphere mirror = {{9, 9, 9}, 1, {{0, 0, 0}, true}};
    const rt_box box = {{1, 1, 1}, {2, 2, 2}, {{1, 1, 1}, false}};
    const rt_vec3 corners[3] = {{1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};
    const int face[3] = {0, 1, 2};
    const rt_mesh mesh = {corners, face, 3, 1, {{1, 1, 1}, false}};
    const rt_light light = {{0, 0, 9}, {1, 1, 1}};
    rt_scene scene;
    rt_camera camera;
    rt_options options;
    rt_image image;
    memset(&scene, 0, sizeof scene);
    memset(&camera, 0, sizeof camera);
    memset(&options, 0, sizeof options);
    memset(&image, 0, sizeof image);
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.boxes = &box;
    scene.box_count = 1;
    scene.meshes = &mesh;
    scene.mesh_count = 1;
    scene.lights = &light;
    scene.light_count = 1;
    options.samples = 1;
    options.threads = 1;
    image.width = 8;
    image.height = 6;
    image.pixels = pixels;
    if (rt_render(&scene, &camera, &options, &image) != RT_OK)
        return 1;
    for (int i = 0; i < 8 * 6; i++) {
        const rt_vec3 right = i % 8 < 4 ? rt_vec(0, 0, 0) : sphere.material.albedo;
        if (memcmp(&pixels[i], &right, sizeof right) != 0)
            return 2;
    }
    scene.spheres = &mirror;
    options.bounces = 1;
    image.samples = 0;
    if (rt_render(&scene, &camera, &options, &image) != RT_OK)
        return 3;
    for (int i = 0; i < 6; i++)
        if (asked[i] == 0)
            return 4 + i;
    return 0;
}

/* Measures rt.h and prints rows, values separated by tabs, for tests/bench/run to put into tables.
 *
 *     bench lanes                 how many rays at a time
 *     bench speed LANES THREADS   millions of rays per second, rays per sample, mean colour
 *     bench live BOUNCES THREADS  pictures of 640 x 480 per second, 1 sample; Mrays/s
 *     bench picture THREADS       seconds for 640 x 480, 64 samples, 5 bounces; Mrays/s
 *     bench growth LANES          spheres, ns per ray, rays per sample, ms to build the tree
 *     bench linear                the same without a tree
 *     bench error                 samples, relative error of random numbers, of Sobol points
 *     bench room                  the numbers of the room, for other programs
 *
 * LANES: 1 is the plain C of the chapters, 0 as many as the machine offers. Times are
 * wall-clock times. */
#define _POSIX_C_SOURCE 200112L /* clock_gettime */
#define RT_IMPLEMENTATION
#include "bench.h"

enum { W = 640, H = 480 };

static rt_vec3 pixels[W * H];

static rt_pixel_function *by_hand; /* in place of rt_render, unless NULL */

/* Render a new picture; returns the time it took. */
static double render(const rt_scene *scene, const rt_options *options, rt_image *image)
{
    image->samples = image->done = 0;
    image->rays = 0;
    const double start = seconds();
    const rt_status status = by_hand ? rt_render_pixels(by_hand, scene, options, image)
                                     : rt_render(scene, &room_camera, options, image);
    const double took = seconds() - start;
    if (status != RT_OK) {
        fprintf(stderr, "bench: %s\n", rt_status_text(status));
        exit(1);
    }
    return took;
}

/* The best time of several equal runs, a third of a second in all: other programs can
 * only add to it. */
static double best_time(const rt_scene *scene, const rt_options *options, rt_image *image)
{
    double best = 1e30, sum = 0.0;
    for (int run = 0; run == 0 || (run < 50 && sum < 0.3); run++) {
        const double took = render(scene, options, image);
        best = took < best ? took : best;
        sum += took;
    }
    return best;
}

static rt_vec3 mean_colour(const rt_image *image)
{
    double sum[3] = {0.0, 0.0, 0.0};
    const int count = image->width * image->height;
    for (int i = 0; i < count; i++) {
        sum[0] += (double)image->pixels[i].x;
        sum[1] += (double)image->pixels[i].y;
        sum[2] += (double)image->pixels[i].z;
    }
    return rt_vec((float)(sum[0] / count), (float)(sum[1] / count),
                  (float)(sum[2] / count));
}

static void speed(int lanes, int threads)
{
    enum { w = W / 4, h = H / 4 };
    rt_image image = {.width = w, .height = h, .pixels = pixels};
    rt_options options = {.samples = 8, .bounces = 5, .threads = threads, .lanes = lanes};
    double best = render(&scene_indirect, &options, &image);
    if (best < 0.5) { /* not where it takes seconds: -O0 */
        options.samples = 8 * (int)(1.0 + 0.15 / best);
        best = best_time(&scene_indirect, &options, &image);
    }
    const rt_vec3 mean = mean_colour(&image);
    printf("%.4f\t%.3f\t%.6f %.6f %.6f\n", (double)image.rays / best / 1e6,
           (double)image.rays / ((double)(w * h) * options.samples), (double)mean.x,
           (double)mean.y, (double)mean.z);
}

static void live(int bounces, int threads)
{
    rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options options = {.samples = 1, .bounces = bounces, .threads = threads};
    const double best = best_time(&scene_indirect, &options, &image);
    printf("%.2f\t%.4f\n", 1.0 / best, (double)image.rays / best / 1e6);
}

static void picture(int threads)
{
    rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options options = {.samples = 64, .bounces = 5, .threads = threads};
    const double took = render(&scene_indirect, &options, &image);
    printf("%.4f\t%.4f\n", took, (double)image.rays / took / 1e6);
}

/* ---- time against the number of shapes ----------------------------------------------- */

/* rt_radiance without a tree: every ray asks every shape. */
static rt_vec3 ask_every_shape(const void *scene, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, W / 4, H / 4, x, y);
    return rt_radiance((const rt_scene *)scene, &ray, 5, rng);
}

static void growth(int lanes, bool tree)
{
    rt_image image = {.width = W / 4, .height = H / 4, .pixels = pixels};
    const rt_options options = {
        .samples = tree ? 4 : 1, .bounces = 5, .threads = 1, .lanes = lanes};
    by_hand = tree ? NULL : ask_every_shape;
    const int counts[] = {10, 40, 60, 80, 150, 300, 1000, 10000, 100000};
    for (int k = 0; k < (tree ? 9 : 7); k++) {
        const int count = counts[k];
        rt_sphere *spheres = many_spheres(count);
        rt_scene scene = {.spheres = spheres,
                          .sphere_count = count + 5,
                          .lights = &room_dim_light,
                          .light_count = 1};
        rt_bvh bvh;
        const double start = seconds();
        if (tree && rt_build_bvh(&scene, &bvh) != RT_OK)
            exit(1);
        const double build = seconds() - start;
        scene.bvh = tree ? &bvh : NULL;
        const double best = best_time(&scene, &options, &image);
        printf("%d\t%.3f\t%.3f\t%.3f\n", count, 1e9 * best / (double)image.rays,
               (double)image.rays / ((double)(W / 4 * H / 4) * options.samples),
               1e3 * build);
        fflush(stdout);
        if (tree)
            rt_free_bvh(&bvh);
        free(spheres);
    }
}

/* ---- error against the number of samples --------------------------------------------- */

/* Root of the mean squared difference, as a part of the mean of the picture. */
static double relative_error(const rt_vec3 *a, const rt_vec3 *exact, int count)
{
    double square = 0.0, sum = 0.0;
    for (int i = 0; i < count; i++) {
        const rt_dvec3 e = rt_to_double(exact[i]);
        const rt_dvec3 d = rt_dsub(rt_to_double(a[i]), e);
        square += rt_ddot(d, d);
        sum += e.x + e.y + e.z;
    }
    return sqrt(square / (3.0 * count)) / (sum / (3.0 * count));
}

/* The mean over some pictures with different seeds. */
static double mean_error(rt_sampler sampler, int samples, const rt_image *exact)
{
    enum { seeds = 2 };
    rt_image image = {.width = exact->width, .height = exact->height, .pixels = pixels};
    double square = 0.0;
    for (uint32_t seed = 0; seed < seeds; seed++) {
        const rt_options options = {
            .samples = samples, .bounces = 5, .seed = seed, .sampler = sampler};
        render(&scene_indirect, &options, &image);
        const double e =
            relative_error(pixels, exact->pixels, image.width * image.height);
        square += e * e;
    }
    return sqrt(square / seeds);
}

static void error(void)
{
    enum { w = 96, h = 72 };
    static rt_vec3 exact_pixels[w * h];
    rt_image exact = {.width = w, .height = h, .pixels = exact_pixels};
    const rt_options options = {.samples = 4096, .bounces = 5, .seed = 12345};
    render(&scene_indirect, &options, &exact);
    for (int samples = 1; samples <= 256; samples *= 4)
        printf("%d\t%.6f\t%.6f\n", samples, mean_error(RT_RANDOM, samples, &exact),
               mean_error(RT_SOBOL, samples, &exact));
}

/* ---- clean pictures ------------------------------------------------------------------ */

/* The room with so many samples, finished: the error before and after, and the least
 * seconds of nine that it took with 1 and 2 threads. If there is a path, it writes there
 * all that others need to do the same: true picture, noisy picture, normal, albedo,
 * direct light. */
static void denoise(int samples, const char *path)
{
    enum { w = 640, h = 480, n = w * h };
    static rt_vec3 pixels[n], half[n], exact_pixels[n], result_pixels[n];
    static rt_guide guides[n];
    rt_image exact = {.width = w, .height = h, .pixels = exact_pixels};
    rt_image image = {
        .width = w, .height = h, .pixels = pixels, .half = half, .guides = guides};
    rt_image result = {.width = w, .height = h, .pixels = result_pixels};
    rt_options options = {.samples = 512, .bounces = 5, .seed = 12345};
    render(&scene_indirect, &options, &exact);
    options.samples = samples;
    options.seed = 0;
    render(&scene_indirect, &options, &image);
    double seconds[2] = {1e9, 1e9};
    for (int k = 0; k < 18; k++) {
        const double start = rt__seconds();
        rt_denoise(&image, 1 + k % 2, &result);
        seconds[k % 2] = fmin(seconds[k % 2], rt__seconds() - start);
    }
    printf("%.5f\t%.5f\t%.4f\t%.4f\n", relative_error(pixels, exact_pixels, n),
           relative_error(result_pixels, exact_pixels, n), seconds[0], seconds[1]);
    FILE *file = path ? fopen(path, "wb") : NULL;
    for (int i = 0; file && i < n; i++) {
        const rt_vec3 all[5] = {exact_pixels[i], pixels[i], guides[i].normal,
                                guides[i].albedo, guides[i].direct};
        fwrite(all, sizeof all, 1, file);
    }
    if (file)
        fclose(file);
}

/* ---- the room, for others ------------------------------------------------------------ */

static void print_vector(rt_vec3 v)
{
    printf("\t%.9g\t%.9g\t%.9g", (double)v.x, (double)v.y, (double)v.z);
}

static void room(void)
{
    printf("camera");
    print_vector(room_camera.position);
    print_vector(room_camera.direction);
    printf("\t%.9g\nlight", (double)room_camera.fov_y);
    print_vector(room_dim_light.position);
    print_vector(room_dim_light.intensity);
    for (int i = 0; i < 7; i++) {
        const rt_sphere *s = &room_spheres[i];
        printf("\n%s", s->material.mirror ? "mirror_sphere" : "sphere");
        print_vector(s->center);
        printf("\t%.9g", (double)s->radius);
        print_vector(s->material.albedo);
    }
    printf("\nbox");
    print_vector(room_cube.min);
    print_vector(room_cube.max);
    print_vector(room_cube.material.albedo);
    printf("\n");
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    const int a = argc > 2 ? atoi(argv[2]) : 0, b = argc > 3 ? atoi(argv[3]) : 0;
    if (strcmp(what, "speed") == 0)
        speed(a, b);
    else if (strcmp(what, "lanes") == 0)
        printf("%d\n", rt_lane_count(0));
    else if (strcmp(what, "live") == 0)
        live(a, b);
    else if (strcmp(what, "picture") == 0)
        picture(a);
    else if (strcmp(what, "growth") == 0)
        growth(a, true);
    else if (strcmp(what, "linear") == 0)
        growth(1, false);
    else if (strcmp(what, "error") == 0)
        error();
    else if (strcmp(what, "denoise") == 0)
        denoise(a, argc > 3 ? argv[3] : NULL);
    else if (strcmp(what, "room") == 0)
        room();
    else
        return fprintf(stderr, "bench: see the head of tests/bench/bench.c\n"), 1;
    return 0;
}

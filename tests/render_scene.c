/* Render a scene file with rt.h, to hold it against another renderer:
 *
 *     build/tests/render_scene SCENE.json [--samples N] [--seed N] --out FILE.pfm
 *     build/tests/render_scene SCENE.json [--samples N] --time LANES
 *
 * The second prints millions of samples per second, on one thread, the best of three times.
 * The schema is in tests/references/scenes/SCHEMA.md. */
#include "scene_file.h"

#include <time.h>

static bool parse_number(const char *text, long *value)
{
    if (!text || !*text || strspn(text, "0123456789") != strlen(text) || strlen(text) > 9)
        return false;
    *value = strtol(text, NULL, 10);
    return true;
}

/* Millions of samples per second, 0 if it cannot be rendered. */
static double speed_of(const scene_file *file, int samples, int lanes, rt_image *image)
{
    const rt_options options = {.samples = samples,
                                .bounces = file->bounces,
                                .threads = 1,
                                .lanes = lanes,
                                .lens = file->lens};
    double best = 0;
    for (int run = 0; run < 3; run++) {
        rt_image_clear(image);
        const clock_t start = clock();
        if (rt_render(&file->scene, &file->camera, &options, image) != RT_OK)
            return 0;
        const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
        const double speed = 1e-6 * image->width * image->height * samples / seconds;
        best = speed > best ? speed : best;
    }
    return best;
}

int main(int argc, char **argv)
{
    const char *path = NULL, *out = NULL;
    long samples = 64, seed = 0, lanes = -1;
    for (int i = 1; i < argc && argv[i]; i++) {
        const char *next = argv[i + 1];
        if (strcmp(argv[i], "--out") == 0 && next)
            out = argv[++i];
        else if (strcmp(argv[i], "--samples") == 0 && parse_number(next, &samples) &&
                 samples)
            i++;
        else if ((strcmp(argv[i], "--seed") == 0 && parse_number(next, &seed)) ||
                 (strcmp(argv[i], "--time") == 0 && parse_number(next, &lanes)))
            i++;
        else if (argv[i][0] != '-' && !path)
            path = argv[i];
        else
            return fprintf(stderr, "render_scene: '%s' is not understood\n", argv[i]), 2;
    }
    if (!path || (!out && lanes < 0))
        return fprintf(stderr, "usage: render_scene SCENE.json [--samples N] [--seed N] "
                               "--out FILE.pfm, or --time LANES\n"),
               2;

    static scene_file file;
    int result = 1;
    if (!read_scene(path, &file)) {
        fprintf(stderr, "render_scene: '%s': %s\n", path, file.error);
    } else {
        rt_image image = {.width = file.width, .height = file.height};
        image.pixels =
            calloc((size_t)file.width * (size_t)file.height, sizeof *image.pixels);
        if (!out) {
            const double speed = speed_of(&file, (int)samples, (int)lanes, &image);
            printf("%.5f\n", speed);
            result = speed > 0 ? 0 : 1;
        } else {
            const rt_status status =
                render_scene(&file, (int)samples, (uint32_t)seed, &image);
            if (status != RT_OK)
                fprintf(stderr, "render_scene: '%s': %s\n", path, rt_status_text(status));
            else if (!write_pfm(out, &image))
                perror(out);
            else
                result = 0;
        }
        free(image.pixels);
    }
    free_scene(&file);
    return result;
}

/* The demos as programs: options, files, messages and exit status. */
#define _DARWIN_C_SOURCE  /* mkdtemp on macOS */
#define _XOPEN_SOURCE 700 /* mkdtemp, popen, realpath, symlink, nftw */
#include "programs.h"
#include "scene_file.h"

#include "../demos/scene.h"

/* ---- what works --------------------------------------------------------------------- */

static void test_help(void **state)
{
    (void)state;
    expect(
        0,
        "WIDTH "
        "HEIGHT|--samples|--error|--time|--bounces|--threads|--lanes|--sampler|--explain|"
        "--seed|--out|--no-window|--quiet|(default random)",
        "demo07 --help");
    expect(0, "(default sobol)|as many as possible", "demo09 --help");
}

static void test_all_write_a_png_to_build(void **state)
{
    (void)state;
    assert_int_equal(mkdir("build", 0777), 0);
    for (int i = 1; i <= 17; i++) {
        static unsigned char bytes[100000];
        char arguments[100], path[40];
        snprintf(arguments, sizeof arguments, "demo%02d 40 30 --samples 2 --no-window",
                 i);
        snprintf(path, sizeof path, "build/demo%02d.png", i);
        expect(0, "40 x 30, 2 samples|bounce|thread|rays per second|wrote build/demo",
               arguments);
        assert_in_range(read_file(path, bytes, sizeof bytes), 100, 20000);
        assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
        assert_memory_equal(bytes + 16, "\0\0\0\x28\0\0\0\x1e", 8); /* 40 x 30 */
        assert_memory_equal(bytes + 24, "\x08\x02", 2);             /* 8 bits, RGB */
    }
}

static void test_pfm(void **state)
{
    /* Little endian, bottom row first: the floor is brighter than the top left corner of
     * the picture, and demo01 is exactly black or the sphere's colour. */
    (void)state;
    static unsigned char bytes[40000];
    expect(0, "wrote a.pfm", "demo01 64 48 --samples 1 --no-window --out a.pfm");
    const size_t size = read_file("a.pfm", bytes, sizeof bytes);
    const char head[] = "PF\n64 48\n-1.0\n";
    assert_int_equal(size, strlen(head) + 64 * 48 * 12);
    assert_memory_equal(bytes, head, strlen(head));
    int red[2] = {0, 0}; /* in the lower and upper half of the picture */
    for (size_t i = 0; i < 64 * 48; i++) {
        const unsigned char *p = bytes + strlen(head) + 12 * i;
        if (memcmp(p, "\x9a\x99\x59\x3f", 4) == 0) /* 0.85f */
            red[i >= 64 * 24]++;
        else
            assert_memory_equal(p, "\0\0\0\0\0\0\0\0\0\0\0\0", 12);
    }
    assert_true(red[0] > 150);
    assert_true(red[1] < red[0] / 5);
}

static void test_one_thread_or_two_the_same_file(void **state)
{
    (void)state;
    expect(0, "1 thread\n",
           "demo07 60 40 --samples 2 --no-window --threads 1 --out 1.png");
    expect(0, "thread", "demo07 60 40 --samples 2 --no-window --threads 2 --out 2.png");
    assert_int_equal(run("cmp 1.png 2.png"), 0);
    expect(0, "", "demo07 60 40 --samples 2 --no-window --seed 1 --out 3.png");
    assert_int_equal(run("cmp 1.png 3.png"), 1);
    char cores[30]; /* 0 is the default: all cores */
    snprintf(cores, sizeof cores, ", %d thread", rt_thread_count(0));
    expect(0, cores, "demo07 60 40 --samples 2 --no-window --threads 0 --out 4.png");
    expect(0, cores, "demo07 60 40 --samples 2 --no-window --out 5.png");
    assert_int_equal(run("cmp 1.png 4.png && cmp 1.png 5.png"), 0);
}

static void test_quiet_is_quiet(void **state)
{
    (void)state;
    expect(0, "", "demo05 20 20 --samples 1 --quiet --out q.png");
    assert_string_equal(said, "");
    assert_true(exists("q.png"));
    expect(0, "", "demo08 20 20 --samples 1 --quiet --out q.png --time 9");
    assert_string_equal(said, "");
    expect(0, "", "demo09 20 20 --samples 1 --quiet --out q.png --error 1");
    assert_string_equal(said, "");
    expect(0, "", "demo02 20 20 --samples 1 --quiet --out q.png --lanes 1");
    assert_string_equal(said, "");
}

/* The closing line is "demo07: 0.12 s, 16 samples, error 1.23 %, ...": read two of them. */
static void read_result(int *samples, double *error)
{
    const char *line = strrchr(said, ':');
    *samples = -1;
    *error = -1.0;
    if (!line || sscanf(line, ": %*f s, %d samples, error %lf %%", samples, error) < 1)
        fail_msg("no result in the last line of: %s", said);
}

static void test_error_ends_the_rendering(void **state)
{
    (void)state;
    int samples, more;
    double error;
    expect(0, "40 x 30, as many samples as it takes, until the error is 20 %, 5 bounces",
           "demo07 40 30 --error 0.2 --no-window --out e.png");
    read_result(&samples, &error);
    assert_in_range(samples, 16, 60);
    assert_true(error > 14.0 && error <= 20.0);
    expect(0, "samples as it takes, until the error is 5 %",
           "demo07 40 30 --error .05 --no-window --out e.png");
    read_result(&more, &error);
    assert_in_range(more, 8 * samples, 32 * samples); /* 16 times as many, about */
    assert_true(error > 4.0 && error <= 5.0);
    expect(0, "", "demo07 40 30 --error 0.05 --sampler sobol --no-window --out e.png");
    read_result(&samples, &error);
    assert_true(samples < more && error <= 5.0);

    expect(0, "", "demo07 40 30 --error 1000. --no-window --out e.png");
    read_result(&samples, &error);
    assert_int_equal(samples, 16); /* fewer are not trusted */
    expect(0, "at most 20 samples, until the error is 1 %",
           "demo07 40 30 --error 0.01 --samples 20 --no-window --out e.png");
    read_result(&samples, &error);
    assert_int_equal(samples, 20);
    assert_true(error > 1.0);
}

static void test_the_error_is_said_where_it_is_known(void **state)
{
    (void)state;
    expect(0, "", "demo07 40 30 --samples 4 --no-window --out e.png");
    assert_null(strstr(said, "error"));
    expect(0, "1 sample, error unknown",
           "demo07 40 30 --samples 1 --error 1 --no-window --out e.png");
}

static void test_time_ends_the_rendering(void **state)
{
    (void)state;
    int samples;
    double error, took;
    expect(0, "100 x 80, as many samples as it takes, for 0.3 s at most, 5 bounces",
           "demo07 100 80 --time 0.3 --no-window --out t.png");
    read_result(&samples, &error);
    assert_in_range(samples, 1, 100000);
    took = strtod(strrchr(said, ':') + 1, NULL);
    assert_true(took >= 0.29 && took < 2.0);
    expect(0, "", "demo07 100 80 --time 0.000001 --no-window --out t.png");
    read_result(&samples, &error);
    assert_int_equal(samples, 1); /* at least one: a whole picture */
    expect(0, "at most 2 samples, for 600 s at most",
           "demo07 40 30 --time 600 --samples 2 --no-window --out t.png");
    read_result(&samples, &error);
    assert_int_equal(samples, 2);
}

static void test_samplers(void **state)
{
    (void)state;
    expect(0, "", "demo07 40 30 --samples 4 --quiet --out 1.png");
    expect(0, "", "demo07 40 30 --samples 4 --quiet --out 2.png --sampler random");
    expect(0, "", "demo07 40 30 --samples 4 --quiet --out 3.png --sampler sobol");
    expect(0, "", "demo08 40 30 --samples 4 --quiet --out 4.png");
    expect(0, "", "demo08 40 30 --samples 4 --quiet --out 5.png --sampler random");
    assert_int_equal(run("cmp 1.png 2.png"), 0);
    assert_int_equal(run("cmp 1.png 3.png"), 1);
    assert_int_equal(run("cmp 3.png 4.png"), 0); /* by chapter 7's code or rt_render */
    assert_int_equal(run("cmp 1.png 5.png"), 0);
}

static void test_lanes(void **state)
{
    (void)state;
    expect(0, "", "demo09 60 40 --samples 4 --quiet --out 1.png --lanes 1");
    for (int lanes = 4; lanes <= 16; lanes *= 2) {
        char arguments[100];
        snprintf(arguments, sizeof arguments,
                 "demo09 60 40 --samples 4 --quiet --out 2.png --lanes %d", lanes);
        if (rt_lane_count(0) != lanes) {
            expect(2, "--lanes: |this build has 1", arguments);
            continue;
        }
        expect(0, "", arguments);
        assert_int_equal(run("cmp 1.png 2.png"), 0);
    }
    expect(0, "--lanes changes nothing",
           "demo05 20 20 --samples 1 --lanes 1 --no-window --out n.png");
    expect(0, "", "demo05 20 20 --samples 1 --no-window --out n.png");
    assert_null(strstr(said, "--lanes"));
}

static void test_chapter_8_times_its_loops(void **state)
{
    (void)state;
    expect(0,
           "without -fopenmp|inner loop|one generator|one variable|right |1 at a "
           "time|packets: "
           "rt_render",
           "demo08 9 9 --samples 1 --no-window --threads 2 --lanes 1 --out m.png");
    int yes = 0, no = 0; /* the loops that are right, and those that are not */
    for (const char *at = said; (at = strstr(at, "   yes\n")) != NULL; at++)
        yes++;
    for (const char *at = said; (at = strstr(at, "   no\n")) != NULL; at++)
        no++;
    assert_int_equal(yes + no, 6);
    assert_in_range(yes, 4, 5); /* a race may go well */
}

static void test_chapter_9_counts_its_points(void **state)
{
    (void)state;
    int samples;
    double random, sobol, error;
    expect(0, "    1 1 1 1 1 1 1 1\n|4 samples|16 samples|64 samples|256 samples",
           "demo09 40 30 --samples 4 --no-window --out m.png");
    assert_int_equal(
        sscanf(strstr(said, "256 samples"), "256 samples %lf %% %lf %%", &random, &sobol),
        2);
    assert_true(random > 5.0 && random < 8.0);
    assert_true(sobol > 2.5 && sobol < random / 1.3);
    read_result(&samples, &error);
    assert_int_equal(samples, 4);
    assert_true(error > 20.0 && error < 80.0);
}

/* The next vector (x, y, z) in the text, which moves on. */
static rt_vec3 next_vec(const char **text)
{
    float v[3];
    *text = strchr(*text, '(') + 1;
    assert_int_equal(sscanf(*text, "%f, %f, %f", &v[0], &v[1], &v[2]), 3);
    return rt_vec(v[0], v[1], v[2]);
}

static void explain_adds_up(const char *demo, int bounces)
{
    const int pixels[5][2] = {{0, 0}, {39, 29}, {20, 15}, {12, 18}, {25, 16}};
    char command[100], began[100];
    snprintf(command, sizeof command,
             "%s 40 30 --samples 3 --quiet --no-denoise --out e.pfm", demo);
    snprintf(began, sizeof began,
             "3 samples, %d bounces|sample 0|sample 2|camera ray meets|mean: ", bounces);
    expect(0, "", command);
    rt_vec3 *picture = read_pfm("e.pfm", 40, 30);
    for (int i = 0; i < 5; i++) {
        char arguments[100];
        snprintf(arguments, sizeof arguments,
                 "%s 40 30 --samples 3 --no-denoise --explain %d,%d", demo, pixels[i][0],
                 pixels[i][1]);
        expect(0, began, arguments);
        rt_vec3 sum = {0, 0, 0}, mean = {0, 0, 0};
        int samples = 0, points = 0;
        for (const char *line = said; line; line = strchr(line, '\n')) {
            line += *line == '\n';
            const char *at = line;
            if (strncmp(line, "  |    adds ", 12) == 0) {
                sum = rt_add(sum, next_vec(&at));
                points++;
            } else if (strncmp(line, "  = ", 4) == 0) {
                const rt_vec3 value = next_vec(&at);
                assert_vec(sum, value.x, value.y, value.z, 2e-5);
                mean = rt_add(mean, rt_scale(value, 1.0f / 3.0f));
                sum = rt_vec(0, 0, 0);
                samples++;
            } else if (strncmp(line, "mean: ", 6) == 0) {
                const rt_vec3 value = next_vec(&at);
                const rt_vec3 *p = &picture[pixels[i][1] * 40 + pixels[i][0]];
                assert_vec(mean, value.x, value.y, value.z, 2e-5);
                assert_vec(value, p->x, p->y, p->z, 1e-5 * (1.0 + (double)p->x));
            }
        }
        assert_int_equal(samples, 3);
        assert_in_range(points, 3, 3 * (bounces + 2));
    }
    free(picture);
}

static void test_explain_adds_up_to_the_pixel(void **state)
{
    (void)state;
    for (int demo = 1; demo <= 17; demo++) {
        char name[20];
        snprintf(name, sizeof name, "demo%02d", demo);
        explain_adds_up(name, demo < 6 ? 0 : demo < 11 ? 5 : 8);
    }
    expect(0, "camera ray meets the red sphere|there is no lamp yet|as bytes 217, 26, 20",
           "demo01 40 30 --explain 12,18");
    expect(0, "whatever is in the way", "demo03 40 30 --explain 12,18");
    expect(0, "glass: refracted, in", "demo11 40 30 --samples 3 --explain 21,23");
    expect(0, "aimed at, weight", "demo12 40 30 --samples 3 --explain 12,18");
    expect(0, "the teapot, triangle |, u 0.|, v 0.",
           "demo16 40 30 --samples 3 --explain 31,22");
    expect(0, "camera ray meets the pedestal at t",
           "demo17 40 30 --samples 3 --explain 31,24");
    expect(2, "--explain: 40,0 is not in a picture of 40 x 30",
           "demo07 40 30 --explain 40,0");
    expect(2, "--explain: '7' is not a pixel", "demo08 --explain 7");
    expect(2, "--explain: '-1,0' is not a pixel", "demo09 --explain -1,0");
    expect(2, "--explain: '1,2,3' is not a pixel", "demo09 --explain 1,2,3");
    expect(2, "--explain: '' is not a pixel", "demo09 --explain");
}

static void test_demos_of_part_two_have_the_pictures_of_rt_h(void **state)
{
    /* By their own routines, which take the place of rt.h's in the program. */
    (void)state;
    const rt_scene *scenes[] = {&scene_glass,    &scene_lamps,    &scene_gloss,
                                &scene_sky,      &scene_patterns, &scene_triangles,
                                &scene_own_shape};
    room_prepare(ON_THE_FLOOR);
    room_prepare(ON_THE_PEDESTAL);
    for (int k = 0; k < 7; k++) {
        static rt_vec3 pixels[40 * 30];
        char arguments[120];
        rt_image image = {.width = 40, .height = 30, .pixels = pixels};
        rt_options options = {.samples = 4, .bounces = 8};
        if (scenes[k]->sky)
            options.lens = room_lens;
        assert_int_equal(rt_render(scenes[k], &room_camera, &options, &image), RT_OK);
        snprintf(arguments, sizeof arguments,
                 "demo%d 40 30 --samples 4 --no-denoise --quiet --out own.pfm", 11 + k);
        expect(0, "", arguments);
        rt_vec3 *own = read_pfm("own.pfm", 40, 30);
        assert_non_null(own);
        assert_memory_equal(own, pixels, sizeof pixels);
        free(own);
    }
}

static void test_exposure_doubles_light_and_not_the_pfm(void **state)
{
    (void)state;
    expect(0, "", "demo05 20 15 --samples 1 --quiet --no-window --out e0.pfm");
    expect(0, "",
           "demo05 20 15 --samples 1 --quiet --no-window --exposure -1.5 --out e1.pfm");
    expect(0, "", "demo05 20 15 --samples 1 --quiet --no-window --out e0.png");
    expect(0, "",
           "demo05 20 15 --samples 1 --quiet --no-window --exposure -1.5 --out e1.png");
    assert_int_equal(run("cmp -s e0.pfm e1.pfm"), 0); /* that is light, as it is */
    assert_int_not_equal(run("cmp -s e0.png e1.png"), 0);
    expect(2, "--exposure: a number is missing", "demo05 --exposure");
    expect(2, "--exposure: 'bright' is not a number of stops, -20 to 20",
           "demo05 --exposure bright");
    expect(2, "--exposure: '21' is not", "demo05 --exposure 21");
    expect(2, "--exposure: '-' is not", "demo05 --exposure -");
    expect(2, "--exposure: 'nan' is not", "demo05 --exposure nan");
}

static void test_a_texture_is_wrapped_around_the_ball(void **state)
{
    (void)state;
    expect(0, "", "demo05 20 20 --samples 1 --quiet --no-window --out t.png");
    expect(0, "", "demo15 40 30 --samples 2 --quiet --no-window --out p0.png");
    expect(0, "",
           "demo15 40 30 --samples 2 --quiet --no-window --texture t.png --out p1.png");
    assert_int_not_equal(run("cmp -s p0.png p1.png"), 0);
    expect(1, "demo15: --texture: cannot read 'none.png' as PNG or JPEG: No such file",
           "demo15 --texture none.png");
    assert_int_equal(run("echo hello >none.png"), 0);
    expect(1, "cannot read 'none.png' as PNG or JPEG", "demo15 --texture none.png");
    expect(1, "--texture: cannot read '.' as PNG or JPEG: Is a directory",
           "demo15 --texture .");
    expect(2, "--texture: a file name is missing", "demo15 --texture");
    expect(2, "--texture: only chapter 15 can do that", "demo14 --texture t.png");
}

static void test_without_a_display_it_says_so_and_goes_on(void **state)
{
    (void)state;
    expect(0, "no window|wrote w.png", "demo05 20 20 --samples 1 --out w.png");
    /* a display that does not exist; then libdbus, which SDL asks, leaks: not ours to
     * find */
    assert_int_equal(
        run("ASAN_OPTIONS=detect_leaks=0 DISPLAY=:77 \"$DEMOS\"/demo05 20 20 "
            "--samples 1 --out x.png"),
        0);
    assert_non_null(strstr(said, "no window"));
    assert_true(exists("x.png"));
}

static void test_plain_lines_when_piped(void **state)
{
    (void)state;
    expect(0, "25 %, |50 %, |75 %, | s left\n",
           "demo07 160 120 --samples 40 --no-window --out p.png");
    assert_null(strchr(said, '\r'));
    assert_null(strchr(said, '\033'));
}

static void test_bounces_where_there_are_none(void **state)
{
    (void)state;
    expect(0, "no bounces yet",
           "demo04 20 20 --samples 1 --bounces 3 --no-window --out n.png");
    expect(0, "3 bounces",
           "demo06 20 20 --samples 1 --bounces 3 --no-window --out n.png");
}

static void test_odd_numbers_of_threads_in_the_environment(void **state)
{
    (void)state;
    const char *values[] = {"0", "-1", "abc", "1000", "3"};
    expect(0, "", "demo07 30 20 --samples 1 --no-window --out 1.png --threads 1");
    for (size_t i = 0; i < COUNT(values); i++) {
        char command[300];
        snprintf(command, sizeof command,
                 "OMP_NUM_THREADS=%s \"$DEMOS\"/demo07 30 20 --samples 1 --no-window "
                 "--out e.png",
                 values[i]);
        const int status = run(command);
        if (status != 0 && strstr(said, "OMP: ")) { /* LLVM 14, before main */
            print_message(
                "note: this OpenMP library itself aborts for OMP_NUM_THREADS=%s\n",
                values[i]);
            continue;
        }
        assert_int_equal(status, 0);
        assert_int_equal(run("cmp 1.png e.png"), 0);
    }
}

static void test_a_closed_pipe_is_an_error_and_the_picture_is_saved(void **state)
{
    (void)state;
    run("{ \"$DEMOS\"/demo07 60 40 --samples 64 --no-window --out h.png; echo $? "
        ">status; } "
        "| head -n 1");
    assert_non_null(strstr(said, "60 x 40"));
    assert_int_equal(run("sleep 0.1; cat status"), 0);
    assert_string_equal(said, "1\n");
    assert_true(exists("h.png"));
    assert_int_equal(run("ls .rt-*"), 2);
}

/* ---- wrong use: one line, status 2 -------------------------------------------------- */

static void test_wrong_use(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"--sample 3", "unknown option '--sample'"},
        {"-x", "unknown option '-x'"},
        {"--samples", "--samples: a number is missing"},
        {"--samples 0", "--samples: '0'"},
        {"--samples -5", "--samples: '-5'"},
        {"--samples abc", "--samples: 'abc'"},
        {"--samples 12x", "--samples: '12x'"},
        {"--samples 1e9", "--samples: '1e9'"},
        {"--samples ''", "--samples: ''"},
        {"--samples ' 5'", "--samples: ' 5'"},
        {"--samples +5", "--samples: '+5'"},
        {"--samples 2.5", "--samples: '2.5'"},
        {"--samples 99999999999", "--samples: '99999999999'"},
        {"--samples 99999999999999999999999", "--samples: '99999999999999999999999'"},
        {"--bounces -1", "--bounces: '-1'"},
        {"--threads -1", "--threads: '-1'"},
        {"--threads 1025", "--threads: '1025' is not a whole number from 0 to 1024"},
        {"--error", "--error: a number is missing"},
        {"--error 0", "--error: '0': the wanted error must be a decimal number above 0"},
        {"--error 0.0", "--error: '0.0'"},
        {"--error -0.1", "--error: '-0.1'"},
        {"--error nan", "--error: 'nan'"},
        {"--error inf", "--error: 'inf'"},
        {"--error abc", "--error: 'abc'"},
        {"--error ''", "--error: ''"},
        {"--error .", "--error: '.'"},
        {"--error 0.1.", "--error: '0.1.'"},
        {"--error 0,1", "--error: '0,1'"},
        {"--error 1e-2", "--error: '1e-2'"},
        {"--error 0x1", "--error: '0x1'"},
        {"--error +1", "--error: '+1'"},
        {"--error ' 1'", "--error: ' 1'"},
        {"--error 1%", "--error: '1%'"},
        {"--error 0.0000000000000000000000000000000000000000000000001", "above 0"},
        {"--error 1000000000000000000000000000000000000000", "--error: '1000000"},
        {"--time", "--time: a number is missing"},
        {"--time 0", "--time: '0': the time in seconds must be a decimal number above 0"},
        {"--time -1", "--time: '-1'"},
        {"--time NaN", "--time: 'NaN'"},
        {"--time infinity", "--time: 'infinity'"},
        {"--time 5s", "--time: '5s'"},
        {"--sampler", "--sampler: a name is missing"},
        {"--sampler halton", "--sampler: 'halton' is not random or sobol"},
        {"--sampler ''", "--sampler: ''"},
        {"--sampler Sobol", "--sampler: 'Sobol'"},
        {"--lanes", "--lanes: a number is missing"},
        {"--lanes -1", "--lanes: '-1'"},
        {"--lanes 2", "--lanes: '2': this build has 1"},
        {"--lanes 12", "--lanes: '12'"},
        {"--lanes 17", "--lanes: '17'"},
        {"--seed 4294967296", "--seed: '4294967296'"},
        {"--seed", "--seed: a number is missing"},
        {"--out", "--out: a file name is missing"},
        {"--out ''", "--out: ''"},
        {"--out picture", "--out: 'picture' does not end in .png or .pfm"},
        {"--out picture.jpg", "--out: 'picture.jpg'"},
        {"--out folder.png/picture", "--out: 'folder.png/picture'"},
        {"0 480", "WIDTH: '0'"},
        {"640 0", "HEIGHT: '0'"},
        {"-640 480", "WIDTH: '-640'"},
        {"640", "HEIGHT: a number is missing"},
        {"640 480 3", "'3' is one argument too many"},
        {"wide 480", "WIDTH: 'wide'"},
        {"99999999999 480", "WIDTH: '99999999999'"},
        {"65536 65536", "65536 x 65536 is too large"},
        {"67108864 67108864", "too large"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char arguments[300];
        snprintf(arguments, sizeof arguments, "demo05 %s", cases[i][0]);
        expect(2, cases[i][1], arguments);
        const char *newline = strchr(said, '\n');
        if (!newline || newline[1] != '\0')
            fail_msg("%s: not one line: %s", arguments, said);
        assert_memory_equal(said, "demo05: ", 8);
    }
    assert_false(exists("picture"));
}

/* ---- failures: one line, status 1, nothing lost ------------------------------------- */

static void test_unwritable_places(void **state)
{
    (void)state;
    static char path[6100] = "demo05 9 9 --samples 1 --quiet --out ";
    assert_int_equal(mkdir("folder.png", 0777), 0);
    write_text("file", "text");
    expect(1, "cannot write 'nowhere/a.png': No such file",
           "demo05 9 9 --samples 1 --quiet --out nowhere/a.png");
    expect(1, "cannot write 'folder.png': Is a directory",
           "demo05 9 9 --samples 1 --quiet --out folder.png");
    expect(1, "cannot write 'file/a.png': Not a directory",
           "demo05 9 9 --samples 1 --quiet --out file/a.png");
    memset(path + strlen(path), 'a', 5000);
    strcat(path, ".png");
    expect(1, "File name too long", path);
    if (geteuid() != 0) { /* root may write anywhere */
        assert_int_equal(mkdir("locked", 0555), 0);
        expect(1, "Permission denied",
               "demo05 9 9 --samples 1 --quiet --out locked/a.png");
    }
}

static void test_it_says_so_before_rendering(void **state)
{
    (void)state;
    expect(1, "cannot write",
           "demo07 8000 8000 --samples 1000 --no-window --out no/a.png");
}

static void test_full_disk(void **state)
{
    (void)state;
    if (!exists("/dev/full")) {
        print_message("note: no /dev/full here: a full disk is not tested\n");
        return;
    }
    assert_int_equal(symlink("/dev/full", "full.png"), 0);
    assert_int_equal(symlink("/dev/full", "full.pfm"), 0);
    expect(1, "cannot write 'full.png': No space left",
           "demo05 20 20 --samples 1 --quiet --out full.png");
    expect(1, "cannot write 'full.pfm': No space left",
           "demo05 200 200 --samples 1 --quiet --out full.pfm");
    struct stat info;
    assert_int_equal(stat("full.png", &info), 0);
    assert_true(S_ISCHR(info.st_mode));
}

static void test_a_file_limit_keeps_the_old_file(void **state)
{
    /* A disk that fills up half-way, imitated by a limit on the size of files. */
    (void)state;
    write_text("old.pfm", "precious");
    assert_int_equal(
        run("trap '' XFSZ; ulimit -f 8; \"$DEMOS\"/demo05 200 200 --samples 1 "
            "--quiet --out old.pfm"),
        1);
    assert_non_null(strstr(said, "cannot write 'old.pfm': File too large"));
    unsigned char bytes[100];
    assert_int_equal(read_file("old.pfm", bytes, sizeof bytes), 8);
    assert_memory_equal(bytes, "precious", 8);
    assert_int_equal(run("ls .rt-*"), 2);
}

static void test_an_existing_file_is_replaced_whole(void **state)
{
    (void)state;
    write_text("again.png", "old");
    write_text(".rt-1.part", "somebody else's");
    expect(0, "", "demo05 20 20 --samples 1 --quiet --out again.png");
    unsigned char bytes[10];
    assert_int_equal(read_file("again.png", bytes, 8), 8);
    assert_memory_equal(bytes, "\x89PNG", 4);
    assert_int_equal(read_file(".rt-1.part", bytes, 8), 8);
    assert_memory_equal(bytes, "somebody", 8);
    assert_int_equal(run("ls .rt-2.part"), 2);
    assert_int_equal(remove(".rt-1.part"), 0);
    assert_int_equal(symlink("again.png", "link.png"), 0);
    expect(0, "", "demo05 30 30 --samples 1 --quiet --out link.png");
    assert_int_equal(run("test -L link.png && test -f again.png"),
                     0); /* the link stays */
}

static void test_full_standard_output(void **state)
{
    (void)state;
    if (!exists("/dev/full")) {
        print_message("note: no /dev/full here: a full disk is not tested\n");
        return;
    }
    assert_int_equal(
        run("\"$DEMOS\"/demo05 9 9 --samples 1 --no-window --out o.png >/dev/full"), 1);
    assert_non_null(strstr(said, "standard output"));
    assert_true(exists("o.png"));
}

static void test_ctrl_c_saves_what_there_is(void **state)
{
    (void)state;
    assert_int_equal(
        run_and_signal("INT",
                       "demo07 200 150 --samples 1000000000 --no-window --out c.png"),
        130);
    assert_non_null(strstr(said, "wrote c.png (interrupted at "));
    assert_true(exists("c.png"));
    assert_int_equal(run("ls .rt-*"), 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_help),
        cmocka_unit_test(test_all_write_a_png_to_build),
        cmocka_unit_test(test_pfm),
        cmocka_unit_test(test_one_thread_or_two_the_same_file),
        cmocka_unit_test(test_quiet_is_quiet),
        cmocka_unit_test(test_error_ends_the_rendering),
        cmocka_unit_test(test_the_error_is_said_where_it_is_known),
        cmocka_unit_test(test_time_ends_the_rendering),
        cmocka_unit_test(test_samplers),
        cmocka_unit_test(test_lanes),
        cmocka_unit_test(test_chapter_8_times_its_loops),
        cmocka_unit_test(test_chapter_9_counts_its_points),
        cmocka_unit_test(test_explain_adds_up_to_the_pixel),
        cmocka_unit_test(test_demos_of_part_two_have_the_pictures_of_rt_h),
        cmocka_unit_test(test_exposure_doubles_light_and_not_the_pfm),
        cmocka_unit_test(test_a_texture_is_wrapped_around_the_ball),
        cmocka_unit_test(test_without_a_display_it_says_so_and_goes_on),
        cmocka_unit_test(test_plain_lines_when_piped),
        cmocka_unit_test(test_bounces_where_there_are_none),
        cmocka_unit_test(test_odd_numbers_of_threads_in_the_environment),
        cmocka_unit_test(test_a_closed_pipe_is_an_error_and_the_picture_is_saved),
        cmocka_unit_test(test_wrong_use),
        cmocka_unit_test(test_unwritable_places),
        cmocka_unit_test(test_it_says_so_before_rendering),
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_a_file_limit_keeps_the_old_file),
        cmocka_unit_test(test_an_existing_file_is_replaced_whole),
        cmocka_unit_test(test_full_standard_output),
        cmocka_unit_test(test_ctrl_c_saves_what_there_is),
    };
    return cmocka_run_group_tests_name("the demos' command line", tests, set_up,
                                       tear_down);
}

/* Parts of a picture as files, and their join: --part and --join of the demos. */
#define _DARWIN_C_SOURCE  /* mkdtemp on macOS */
#define _XOPEN_SOURCE 700 /* mkdtemp, popen, realpath, symlink, nftw */
#include "programs.h"

enum { BYTES = 200000 };

#define SMALL "demo08 40 30 --samples 2 --out p.pfm "

/* All parts of a picture, from the last to the first. */
static void render_parts(const char *arguments, int parts)
{
    for (int k = parts; k >= 1; k--) {
        char line[400];
        snprintf(line, sizeof line, "%s --quiet --part %d/%d", arguments, k, parts);
        expect(0, "", line);
    }
}

static void test_parts_make_the_whole_picture(void **state)
{
    (void)state;
    const char *const pictures[] = {
        "demo05 40 30 --samples 3",
        "demo07 40 30 --samples 4 --seed 7 --denoise",
        "demo08 41 31 --samples 4",
        "demo08 41 31 --samples 4 --sampler random --bounces all",
        "demo10 40 30 --samples 4",
        "demo14 40 30 --samples 4 --no-denoise",
        "demo09 8 6 --samples 1500", /* its means have a rest */
        "demo17 40 30 --samples 2"};
    const int parts[] = {1, 2, 7};
    for (size_t i = 0; i < COUNT(pictures); i++)
        for (size_t j = 0; j < COUNT(parts); j++) {
            char line[300];
            assert_int_equal(run("rm -f *"), 0);
            snprintf(line, sizeof line, "%s --no-window --quiet --out whole.pfm",
                     pictures[i]);
            expect(0, "", line);
            snprintf(line, sizeof line, "%s --out p.pfm", pictures[i]);
            render_parts(line, parts[j]);
            snprintf(line, sizeof line, "%s --out p.pfm --join %d", pictures[i],
                     parts[j]);
            expect(0, " part|million rays|wrote p.pfm", line);
            assert_int_equal(run("cmp whole.pfm p.pfm"), 0);
        }
}

static void test_a_pixel_a_part_and_a_png(void **state)
{
    (void)state;
    render_parts("demo06 4 3 --samples 2 --out tiny.png", 12);
    expect(0, "12 parts", "demo06 4 3 --samples 2 --exposure 1 --join 12 --out tiny.png");
    expect(
        0, "",
        "demo06 4 3 --samples 2 --exposure 1 --no-window --quiet --out tiny-whole.png");
    assert_int_equal(run("cmp tiny.png tiny-whole.png"), 0);
}

/* What a part's file says: where in the picture it is, and how many rays it took. */
typedef struct place {
    long long first, count, rays;
} place;

static place read_place(const char *path)
{
    static unsigned char bytes[BYTES];
    place p = {0};
    const size_t size = read_file(path, bytes, sizeof bytes - 1);
    bytes[size] = '\0';
    const char *line = strstr((char *)bytes, "\nfirst ");
    if (!line || sscanf(line, "\nfirst %lld\ncount %lld\nrays %lld\n", &p.first, &p.count,
                        &p.rays) != 3)
        fail_msg("%s does not say where it is", path);
    return p;
}

/* Parts that do not divide the pixels: each begins where the one before ends, the last
 * ends at the last pixel. Their sizes differ by one pixel at most. The files tell; a join
 * would not notice pixels that two parts have. */
static void test_parts_neither_overlap_nor_leave_gaps(void **state)
{
    (void)state;
    const struct {
        int width, height, parts;
    } cases[] = {{40, 30, 7}, {41, 31, 7}, {41, 31, 2}, {7, 3, 20}, {5, 1, 3}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        const int all = cases[i].width * cases[i].height, n = cases[i].parts;
        long long end = 0;
        char line[200], path[100];
        assert_int_equal(run("rm -rf *"), 0);
        snprintf(line, sizeof line,
                 "demo05 %d %d --samples 1 --quiet --out c.pfm --part all/%d",
                 cases[i].width, cases[i].height, n);
        expect(0, "", line);
        for (int k = 1; k <= n; k++) {
            snprintf(path, sizeof path, "c-part-%d-of-%d.part", k, n);
            const place p = read_place(path);
            if (p.first != end || p.count < all / n || p.count > all / n + 1)
                fail_msg("%s: first %lld, count %lld, after %lld pixels of %d", path,
                         p.first, p.count, end, all);
            end += p.count;
        }
        assert_int_equal(end, all);
    }
}

/* Pixels times parts is more than an int holds. */
static void test_thousands_of_parts_of_a_large_picture(void **state)
{
    (void)state;
    const char *arguments = "demo05 640 480 --samples 1 --quiet --out l.pfm";
    char line[200];
    assert_int_equal(run("rm -rf *"), 0);
    for (int k = 7000; k <= 7001; k++) {
        snprintf(line, sizeof line, "%s --part %d/7001", arguments, k);
        expect(0, "", line);
    }
    const place p = read_place("l-part-7000-of-7001.part");
    const place last = read_place("l-part-7001-of-7001.part");
    assert_int_equal(p.first, 307112); /* 307200 * 6999 / 7001 = 307112.2 */
    assert_int_equal(p.first + p.count, last.first);
    assert_int_equal(last.first + last.count, 640 * 480);
}

/* One part has as many rays as seven, in their files and in what the join says. */
static void test_the_rays_of_all_parts_are_added(void **state)
{
    (void)state;
    const int parts[] = {1, 7};
    long long sums[COUNT(parts)] = {0};
    assert_int_equal(run("rm -rf *"), 0);
    for (size_t i = 0; i < COUNT(parts); i++) {
        char line[200], path[100], words[100];
        const char *arguments = "demo08 41 31 --samples 100 --out r.pfm";
        render_parts(arguments, parts[i]);
        for (int k = 1; k <= parts[i]; k++) {
            snprintf(path, sizeof path, "r-part-%d-of-%d.part", k, parts[i]);
            sums[i] += read_place(path).rays;
        }
        snprintf(words, sizeof words, ", %.1f million rays", (double)sums[i] * 1e-6);
        snprintf(line, sizeof line, "%s --join %d", arguments, parts[i]);
        expect(0, words, line);
    }
    assert_true(sums[0] > 41 * 31 * 100 * 2); /* of the camera, and to the light */
    assert_int_equal(sums[0], sums[1]);
}

static int count_of(const char *word)
{
    int count = 0;
    for (const char *at = said; (at = strstr(at, word)) != NULL; at++)
        count++;
    return count;
}

static void test_sixty_parts_killed_and_resumed(void **state)
{
    (void)state;
    const char *all = "xargs -P 2 -I@ \"$DEMOS\"/demo08 160 120 --samples 64 "
                      "--out a.png --threads 1 --part @/60 <numbers";
    char line[600];
    assert_int_equal(run("seq 60 >numbers"), 0);
    snprintf(
        line, sizeof line,
        "%s >log.txt 2>&1 & x=$!; "
        "for i in $(seq 400); do [ -e a-part-12-of-60.part ] && break; sleep 0.02; "
        "done; kill -KILL $x $(ps -A -o pid=,ppid= | awk -v x=$x '$2 == x { print $1 "
        "}') 2>/dev/null; sleep 0.2; ls a-part-*-of-60.part | wc -l",
        all);
    assert_int_equal(run(line), 0);
    const int before = atoi(said);
    assert_in_range(before, 11, 59);
    char words[100];
    snprintf(words, sizeof words, "cannot join 'a-part-|No such file|(%d of 60 parts",
             before);
    expect(1, words, "demo08 160 120 --samples 64 --out a.png --join 60");
    assert_false(exists("a.png"));
    assert_int_equal(run(all), 0);
    assert_int_equal(count_of("is there already"), before);
    assert_int_equal(count_of("wrote a-part-"), 60 - before);
    expect(0, "60 parts|wrote a.png",
           "demo08 160 120 --samples 64 --out a.png --join 60");
    expect(0, "", "demo08 160 120 --samples 64 --quiet --no-window --out w.png");
    assert_int_equal(run("cmp a.png w.png"), 0);
}

/* ---- what is refused ---------------------------------------------------------------- */

/* Two good parts of SMALL, and a picture that must stay. */
static void begin_anew(void)
{
    assert_int_equal(run("rm -rf *"), 0);
    render_parts(SMALL, 2);
    write_text("p.pfm", "precious");
}

/* The join says one line that names the file, and leaves the picture. */
static void expect_refusal(const char *file, const char *words, const char *arguments)
{
    char name[100];
    unsigned char bytes[20];
    expect(1, words, arguments);
    snprintf(name, sizeof name, "'%s'", file);
    if (!strstr(said, name) || strchr(said, '\n') != said + strlen(said) - 1)
        fail_msg("not one line with %s: %s", name, said);
    assert_int_equal(read_file("p.pfm", bytes, sizeof bytes), 8);
    assert_memory_equal(bytes, "precious", 8);
}

#define FIRST "p-part-1-of-2.part"
#define SECOND "p-part-2-of-2.part"

static void test_other_parts_are_not_joined(void **state)
{
    (void)state;
    const char *const cases[][2] = {
        {"demo09 40 30 --samples 2 --out p.pfm", "'demo09' and not 'demo08'"},
        {"demo08 30 40 --samples 2 --out p.pfm", "'30 x 40' and not '40 x 30'"},
        {SMALL "--samples 3", "'samples 3' and not 'samples 2'"},
        {SMALL "--bounces 4", "'bounces 4' and not 'bounces 5'"},
        {SMALL "--sampler random", "'sampler random' and not 'sampler sobol'"},
        {SMALL "--seed 1", "'seed 1' and not 'seed 0'"},
        {SMALL "--denoise", "'half yes' and not 'half no'"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char line[200];
        begin_anew();
        assert_int_equal(remove(SECOND), 0);
        snprintf(line, sizeof line, "%s --part 2/2", cases[i][0]);
        expect(0, "wrote " SECOND, line);
        expect_refusal(SECOND, cases[i][1], SMALL "--join 2");
        expect_refusal(SECOND, cases[i][1], SMALL "--part 2/2"); /* nor replaced */
        expect(0, "there already", line);
    }
}

static void test_another_scene_is_another_picture(void **state)
{
    (void)state;
    begin_anew();
    expect(0, "", "demo05 20 20 --samples 1 --quiet --no-window --out t.png");
    render_parts("demo15 40 30 --samples 2 --texture t.png --out p.pfm", 1);
    expect_refusal("p-part-1-of-1.part", "'given ",
                   "demo15 40 30 --samples 2 --out p.pfm --join 1");
    expect(0, "", "demo15 40 30 --samples 2 --texture t.png --out p.pfm --join 1");
    begin_anew();
    assert_int_equal(run("LC_ALL=C sed -i 's/^scene ./scene x/' " SECOND), 0);
    expect_refusal(SECOND, "'scene x", SMALL "--join 2");
}

static void test_missing_and_overlapping_parts(void **state)
{
    (void)state;
    begin_anew();
    assert_int_equal(rename(SECOND, "elsewhere"), 0);
    expect_refusal(SECOND, "No such file|(1 of 2 parts", SMALL "--join 2");
    assert_int_equal(run("cp " FIRST " " SECOND), 0);
    expect_refusal(SECOND, "'first 0' and not 'first 600'", SMALL "--join 2");
    assert_int_equal(run("mv " FIRST " p-part-1-of-3.part"), 0);
    expect_refusal("p-part-1-of-3.part", "'count 600' and not 'count 400'",
                   SMALL "--join 3");
}

/* The file's bytes have changed: give them the right sum again. */
static void sum_anew(unsigned char *bytes, size_t size)
{
    uint64_t sum = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < size - 8; i++)
        sum = (sum ^ bytes[i]) * UINT64_C(1099511628211);
    for (int i = 0; i < 8; i++)
        bytes[size - 8 + (size_t)i] = (unsigned char)(sum >> 8 * i);
}

static void write_bytes(const char *path, const unsigned char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void test_damaged_parts_are_not_joined_but_rendered_again(void **state)
{
    (void)state;
    static unsigned char good[BYTES], bytes[BYTES], again[BYTES];
    enum {
        CUT_1,
        CUT_100,
        CUT_10,
        EMPTY,
        LONGER,
        FLIPPED,
        RAYS,
        NAN_FIRST,
        NAN_LAST,
        INF_IN_IT,
        ALL
    };
    for (int kind = 0; kind < ALL; kind++) {
        begin_anew();
        const size_t all = read_file(SECOND, good, sizeof good);
        size_t size = all;
        const char *why = "its sum is wrong";
        memcpy(bytes, good, all);
        unsigned char *rays = (unsigned char *)strstr((char *)bytes, "rays ") + 5;
        unsigned char *floats = (unsigned char *)strchr((char *)rays, '\n') + 1;
        switch (kind) {
        case CUT_1:
            size -= 1;
            why = "bytes instead of";
            break;
        case CUT_100:
            size = 150;
            why = "it ends after 150 bytes";
            break;
        case CUT_10:
            size = 10;
            why = "it ends after 10 bytes";
            break;
        case EMPTY:
            size = 0;
            why = "it ends after 0 bytes";
            break;
        case LONGER:
            size += 1;
            why = "bytes instead of";
            break;
        case FLIPPED: floats[500] ^= 1; break;
        case RAYS: *rays = (unsigned char)(*rays == '1' ? '2' : '1'); break;
        case NAN_FIRST:
        case NAN_LAST:
        case INF_IN_IT:
            if (kind == NAN_LAST)
                floats = bytes + size - 8 - 4; /* before the sum */
            else if (kind == INF_IN_IT)
                floats += 24;
            memcpy(floats, kind == INF_IN_IT ? "\0\0\x80\xff" : "\0\0\xc0\x7f", 4);
            sum_anew(bytes, size);
            why = "it has pixels that are NaN or infinite";
            break;
        default: break;
        }
        if (kind == CUT_100) /* before the rays are known */
            assert_true(rays - bytes > 150);
        write_bytes(SECOND, bytes, size);
        expect_refusal(SECOND, why, SMALL "--join 2");
        expect(0, "; once more|wrote " SECOND, SMALL "--part 2/2");
        assert_int_equal(read_file(SECOND, again, sizeof again), all);
        assert_memory_equal(again, good, all);
    }
}

/* The means of every second sample are pixels, too. */
static void test_half_without_a_value_is_not_joined(void **state)
{
    (void)state;
    static unsigned char bytes[BYTES];
    enum { PIXELS = 40 * 30, VECTOR = 12 };
    const char *demo = "demo07 40 30 --samples 4 --denoise --quiet --out p.pfm";
    char line[200];
    begin_anew();
    render_parts(demo, 1);
    const size_t size = read_file("p-part-1-of-1.part", bytes, sizeof bytes);
    unsigned char *rays = (unsigned char *)strstr((char *)bytes, "rays ");
    unsigned char *half =
        (unsigned char *)strchr((char *)rays, '\n') + 1 + PIXELS * VECTOR;
    memcpy(half + VECTOR, "\0\0\xc0\x7f", 4);
    sum_anew(bytes, size);
    write_bytes("p-part-1-of-1.part", bytes, size);
    snprintf(line, sizeof line, "%s --join 1", demo);
    expect_refusal("p-part-1-of-1.part", "NaN or infinite", line);
}

static void test_what_is_no_part(void **state)
{
    (void)state;
    begin_anew();
    write_text(SECOND, "a shopping list\n");
    expect_refusal(SECOND, "it is no part of a picture", SMALL "--join 2");
    expect_refusal(SECOND, "it is no part of a picture", SMALL "--part 2/2");
    write_text(SECOND, "b");
    expect_refusal(SECOND, "it is no part of a picture", SMALL "--join 2");
    assert_int_equal(run("rm " SECOND "; mkdir " SECOND), 0);
    expect_refusal(SECOND, "Is a directory", SMALL "--join 2");
    expect_refusal(SECOND, "Is a directory", SMALL "--part 2/2");
    assert_int_equal(run("rmdir " SECOND "; ln -s /dev/null " SECOND), 0);
    expect_refusal(SECOND, "Invalid argument", SMALL "--join 2");
    if (geteuid() != 0) { /* root may read all */
        assert_int_equal(run("rm " SECOND "; cp " FIRST " " SECOND), 0);
        assert_int_equal(chmod(SECOND, 0), 0);
        expect_refusal(SECOND, "Permission denied", SMALL "--join 2");
    }
}

static void test_wrong_use(void **state)
{
    (void)state;
    const char *const cases[][2] = {
        {"--part 0/4", "--part: '0/4' is not K/N"},
        {"--part 5/4", "--part: '5/4' is not K/N"},
        {"--part x", "--part: 'x' is not K/N"},
        {"--part ''", "--part: '' is not K/N"},
        {"--part", "--part: '' is not K/N"},
        {"--part 3", "--part: '3' is not K/N"},
        {"--part all", "--part: 'all' is not K/N"},
        {"--part all/", "--part: 'all/' is not K/N"},
        {"--part all/0", "--part: 'all/0' is not K/N"},
        {"--part al/3", "--part: 'al/3' is not K/N"},
        {"--part all/1201", "--part: there are more parts than pixels"},
        {"--part all/2 --join 2", "one part or one join at a time"},
        {"--part all/2 --time 1", "--part: not with --error or --time"},
        {"--part all/2 --preview", "--part: not with --preview"},
        {"--part 3/", "--part: '3/' is not K/N"},
        {"--part /3", "--part: '/3' is not K/N"},
        {"--part -1/3", "--part: '-1/3' is not K/N"},
        {"--part 1/3x", "--part: '1/3x' is not K/N"},
        {"--part 1/2/3", "--part: '1/2/3' is not K/N"},
        {"--part ' 1/3'", "--part: ' 1/3' is not K/N"},
        {"--part 1/99999999999999999999999", "is not K/N"},
        {"--part 1/1201", "--part: there are more parts than pixels"},
        {"--part 1/2 --part 2/2", "one part or one join at a time"},
        {"--part 1/2 --join 2", "one part or one join at a time"},
        {"--part 1/2 --error 0.1", "--part: not with --error or --time"},
        {"--part 1/2 --time 1", "--part: not with --error or --time"},
        {"--part 1/2 --explain 1,1", "--part: not with --explain"},
        {"--part 1/2 --preview", "--part: not with --preview"},
        {"--join", "--join: a number is missing"},
        {"--join 0", "--join: '0' is not a whole number"},
        {"--join x", "--join: 'x' is not a whole number"},
        {"--join 2 --time 1", "--join: not with --error or --time"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char line[200];
        snprintf(line, sizeof line, "demo07 40 30 %s", cases[i][0]);
        expect(2, cases[i][1], line);
        if (strchr(said, '\n') != said + strlen(said) - 1)
            fail_msg("%s: not one line: %s", line, said);
    }
    expect(0, "--part K/N|--join N", "demo08 --help");
}

/* ---- nothing half-done looks done --------------------------------------------------- */

static void test_a_full_disk_leaves_no_part(void **state)
{
    (void)state;
    assert_int_equal(run("rm -rf * .rt-*"), 0);
    assert_int_equal(run("trap '' XFSZ; ulimit -f 8; \"$DEMOS\"/demo05 200 200 --samples "
                         "1 --quiet --out f.png --part 1/2"),
                     1);
    assert_non_null(strstr(said, "cannot write 'f-part-1-of-2.part': File too large"));
    assert_int_equal(run("ls -A | grep -E 'f-part|rt-'"), 1);
    expect(1, "cannot write 'nowhere/f-part-1-of-2.part': No such file",
           "demo07 8000 8000 --samples 1000 --out nowhere/f.png --part 1/2");
}

static void test_pixels_without_a_value_are_not_written(void **state)
{
    (void)state;
    const char *why = "'b-part-1-of-2.part' is not written: 30 of 100 pixels are NaN";
    expect(1, why, "tests/broken 10 20 --out b.pfm --part 1/2");
    expect(1, why, "tests/broken 10 20 --out b.pfm --part all/2");
    assert_int_equal(run("ls -A | grep -E 'b-part|rt-'"), 1);
    expect(0, "warning: 60 of 200 pixels are NaN",
           "tests/broken 10 20 --no-window --out b.pfm");
}

/* ---- all that are missing ----------------------------------------------------------- */

static void test_all_parts_one_after_the_other(void **state)
{
    (void)state;
    assert_int_equal(run("rm -rf *"), 0);
    expect(0, "wrote p-part-2-of-3.part; 1 of 3 are there", SMALL "--part 2/3");
    expect(
        0,
        "wrote p-part-1-of-3.part; 2 of 3|part 2 of 3 is there|wrote p-part-3-of-3.part; "
        "3 of 3",
        SMALL "--part all/3");
    expect(0, "3 parts", SMALL "--join 3");
    expect(0, "", SMALL "--no-window --quiet --out whole.pfm");
    assert_int_equal(run("cmp p.pfm whole.pfm"), 0);
    assert_int_equal(run("cp p-part-1-of-3.part p-part-2-of-3.part; rm p-part-3*"), 0);
    expect(1, "'p-part-2-of-3.part': it is another part", SMALL "--part all/3");
    assert_false(exists("p-part-3-of-3.part"));
}

static void test_ctrl_c_leaves_the_parts_that_are_done(void **state)
{
    (void)state;
    const char *all =
        "demo08 160 120 --samples 700 --threads 1 --out d.pfm --part all/10";
    char line[600];
    snprintf(line, sizeof line,
             "\"$DEMOS\"/%s >log.txt 2>&1 & demo=$!; for i in $(seq 400); do "
             "[ -e d-part-2-of-10.part ] && break; sleep 0.02; done; "
             "kill -INT $demo; wait $demo; status=$?; cat log.txt; exit $status",
             all);
    assert_int_equal(run(line), 130);
    assert_non_null(strstr(said, " of 10 is not written"));
    const int done = count_of("wrote ");
    assert_in_range(done, 2, 9);
    expect(0, "10 of 10 are there", all);
    assert_int_equal(count_of("is there already"), done);
    assert_int_equal(count_of("wrote "), 10 - done);
}

/* Three parts came in the last six seconds, before this one, and another long ago: for the four
 * that are missing it takes as long as for these four. */
static void test_the_time_that_is_left(void **state)
{
    (void)state;
    assert_int_equal(run("rm -rf *"), 0);
    render_parts(SMALL, 5);
    assert_int_equal(run("for k in 1 2 3 4 5; do mv p-part-$k-of-5.part "
                         "p-part-$k-of-9.part; done; touch -d '1 hour ago' p-part-1-*; "
                         "for k in 2 3 4; do touch -d \"$((10 - 2 * k)) seconds ago\" "
                         "p-part-$k-*; done; rm p-part-5-*"),
                     0);
    expect(0, "5 of 9 are there, ", SMALL "--part 5/9");
    const int left = atoi(strstr(said, "are there, ") + 11);
    assert_in_range(left, 5, 8); /* 4 x 6 s / 4, or a second more */
    expect(0, "", "demo08 40 30 --samples 2 --out q.pfm --part 1/2");
    assert_null(strstr(said, " left")); /* nobody can tell */
}

static void test_ctrl_c_leaves_no_part(void **state)
{
    (void)state;
    assert_int_equal(
        run("\"$DEMOS\"/demo08 200 150 --samples 1000000000 --out c.png --part 1/2 "
            ">log.txt 2>&1 & demo=$!; sleep 0.7; kill -INT $demo; wait $demo; "
            "status=$?; cat log.txt; exit $status"),
        130);
    assert_non_null(strstr(said, "interrupted, part 1 of 2 is not written"));
    assert_int_equal(run("ls -A | grep -E 'c-part|rt-'"), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts_make_the_whole_picture),
        cmocka_unit_test(test_a_pixel_a_part_and_a_png),
        cmocka_unit_test(test_parts_neither_overlap_nor_leave_gaps),
        cmocka_unit_test(test_thousands_of_parts_of_a_large_picture),
        cmocka_unit_test(test_the_rays_of_all_parts_are_added),
        cmocka_unit_test(test_sixty_parts_killed_and_resumed),
        cmocka_unit_test(test_other_parts_are_not_joined),
        cmocka_unit_test(test_another_scene_is_another_picture),
        cmocka_unit_test(test_missing_and_overlapping_parts),
        cmocka_unit_test(test_damaged_parts_are_not_joined_but_rendered_again),
        cmocka_unit_test(test_half_without_a_value_is_not_joined),
        cmocka_unit_test(test_what_is_no_part),
        cmocka_unit_test(test_wrong_use),
        cmocka_unit_test(test_a_full_disk_leaves_no_part),
        cmocka_unit_test(test_ctrl_c_leaves_no_part),
        cmocka_unit_test(test_pixels_without_a_value_are_not_written),
        cmocka_unit_test(test_all_parts_one_after_the_other),
        cmocka_unit_test(test_ctrl_c_leaves_the_parts_that_are_done),
        cmocka_unit_test(test_the_time_that_is_left),
    };
    return cmocka_run_group_tests_name("parts of a picture", tests, set_up, tear_down);
}

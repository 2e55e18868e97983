/* make starters, make try, make grade: what students and teachers see. The whole session of
 * docs/teaching.md is "tests/check classroom". */
#define _XOPEN_SOURCE 700 /* nftw, mkdtemp, setenv */
#include "programs.h"

/* Run the classroom's script; it uses the folder of the project and writes to this one. */
static void expect_run(int status, const char *words, const char *arguments)
{
    char line[500];
    snprintf(line, sizeof line,
             "mkdir -p b && b=$PWD/b && cd \"$TOP\" && "
             "BUILD=$b SEED=%s OUT=$b/marks.csv tests/classroom/run %s",
             getenv("SEED_TO_TRY") ? getenv("SEED_TO_TRY") : "0", arguments);
    const int actual = run(line);
    if (actual != status)
        fail_msg("%s: exit status %d, expected %d; it said: %s", arguments, actual,
                 status, said);
    char list[700];
    snprintf(list, sizeof list, "%s", words);
    for (char *word = strtok(list, "|"); word; word = strtok(NULL, "|"))
        if (!strstr(said, word))
            fail_msg("%s: no '%s' in: %s", arguments, word, said);
}

static void test_starters_compile(void **state)
{
    (void)state;
    assert_int_equal(run("cd \"$TOP\" && tests/classroom/starter \"$OLDPWD\"/starters"),
                     0);
    assert_int_equal(
        run("cd starters && test $(ls | wc -l) = 23 && for f in *.c; do "
            "cc -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I\"$TOP\" "
            "$f || exit 1; done"),
        0);
    assert_string_equal(said, "");
    /* where the comment of a routine points up, to a derivation, the starter has it, too */
    assert_int_equal(run("cd starters && grep -q '<f,u>' my_hit_sphere.c && "
                         "grep -q 't_in = max' my_hit_box.c && "
                         "grep -q 'w_C = ' my_hit_triangle.c && for f in *.c; do "
                         "! tr -s '\\n *' ' ' <$f | grep -qi 'see above' || "
                         "test $(grep -c '^/[*]' $f) -ge 3 || echo $f; done"),
                     0);
    assert_string_equal(said, "");
    /* what a student has written is kept */
    write_text("starters/my_reflect.c", "mine");
    assert_int_equal(
        run("cd \"$TOP\" && tests/classroom/starter \"$OLDPWD\"/starters rt_reflect"), 0);
    assert_non_null(strstr(said, "my_reflect.c is there: kept"));
    assert_int_equal(run("cat starters/my_reflect.c"), 0);
    assert_string_equal(said, "mine");
    assert_int_equal(run("cd \"$TOP\" && tests/classroom/starter x rt_nothing"), 2);
    assert_non_null(strstr(said, "'rt_nothing' is none of: rt_camera_ray"));
}

static void test_a_wrong_routine_is_told_on_which_input(void **state)
{
    (void)state;
    expect_run(0,
               "bert.c: rt_hit_sphere: directions of any length|input 1 of 200: center "
               "|yours: hit 1|"
               "right: hit 1|6/8",
               "grade tests/classroom/submissions/bert.c");
    char first[2000];
    snprintf(first, sizeof first, "%.1999s", said);
    setenv("SEED_TO_TRY", "7",
           1); /* another student number: other inputs, the same marks */
    expect_run(0, "bert.c: rt_hit_sphere: directions of any length|6/8",
               "grade tests/classroom/submissions/bert.c");
    unsetenv("SEED_TO_TRY");
    assert_string_not_equal(first, said);
}

static void test_marks_of_a_folder(void **state)
{
    (void)state;
    assert_int_equal(run("mkdir -p class && cd class && for s in anna gus hal lea; do "
                         "cp \"$TOP\"/tests/classroom/submissions/$s.c .; done; mkdir -p "
                         "none 'odd,\"name'; "
                         "rm -f /tmp/rt-gus-was-here"),
                     0);
    expect_run(
        0,
        "anna.c                     8/8|gus.c: rt_reflect: unit vectors: ended by the "
        "system|hal.c: rt_reflect: unit vectors: ended by the system|lea.c: empty|none: "
        "no "
        "file with a name that ends in .c|wrote ",
        "grade \"$OLDPWD\"/class");
    assert_false(exists("/tmp/rt-gus-was-here"));
    assert_int_equal(run("cat b/marks.csv"), 0);
    assert_non_null(strstr(said, "name,chapter 1,of,chapter 2,of,"));
    assert_non_null(strstr(said, "\n\"anna.c\",8,8,0,0,"));
    assert_non_null(
        strstr(said, "\n\"gus.c\",0,0,0,0,0,0,0,0,0,0,0,2,0,0,0,0,0,0,0,0,0,0,0,0\n"));
    assert_non_null(strstr(said, "\n\"odd,\"\"name\",0,0,"));
}

/* Part two: routines that use their random numbers in another way are right, too; and what is wrong
 * is told in words. */
static void test_marks_of_part_two(void **state)
{
    (void)state;
    assert_int_equal(
        run("mkdir -p two && cd two && for s in mona nils olga paul quin "
            "rosa sven tara; do cp \"$TOP\"/tests/classroom/submissions/$s.c .; done"),
        0);
    expect_run(
        0,
        "nils.c: rt_fresnel: from outside|nils.c: rt_refract: total reflection|"
        "it is on the far side of the ball|paul.c: rt_lamp_density: a small ball|"
        "paul.c: rt_mis: very large and very small|"
        "the facets are not chosen as often as the eye sees them|"
        "rosa.c: rt_gloss: shininess 2 to 50|it passes by the sharp point|"
        "sven.c: rt_hit_triangle: to a common edge or corner: no leak: a leak: the ray "
        "goes between this triangle|"
        "chapter                      1     2     3     4     5     6     7    11    "
        "12    13    14    16    total",
        "grade \"$OLDPWD\"/two");
    assert_int_equal(run("tail -8 b/marks.csv | sed 's/,0,0,0,0,0,0,0,0,0,0,0,0,0,0//'"),
                     0);
    assert_string_equal(
        said, "\"mona.c\",8,8,0,0,0,0,0,0,0,0\n\"nils.c\",4,8,0,0,0,0,0,0,0,0\n"
              "\"olga.c\",0,0,11,11,0,0,0,0,0,0\n\"paul.c\",0,0,4,11,0,0,0,0,0,0\n"
              "\"quin.c\",0,0,0,0,7,7,4,4,0,0\n\"rosa.c\",0,0,0,0,3,7,1,4,0,0\n"
              "\"sven.c\",0,0,0,0,0,0,0,0,9,11\n\"tara.c\",0,0,0,0,0,0,0,0,11,11\n");
}

static void test_what_cannot_be_marked(void **state)
{
    (void)state;
    expect_run(2, "No such file", "grade tests/nobody.c");
    expect_run(2, "a folder, not a file", "try tests");
    expect_run(2, "which file? make grade FILE=", "grade");
    expect_run(2, "tests/classroom/run try FILE", "");
    setenv("SEED_TO_TRY", "7x", 1);
    expect_run(2, "--seed: '7x' is not a number",
               "grade tests/classroom/submissions/anna.c");
    unsetenv("SEED_TO_TRY");
    expect_run(0, "rt.h: replaces nothing", "grade rt.h");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_starters_compile),
        cmocka_unit_test(test_a_wrong_routine_is_told_on_which_input),
        cmocka_unit_test(test_marks_of_a_folder),
        cmocka_unit_test(test_marks_of_part_two),
        cmocka_unit_test(test_what_cannot_be_marked),
    };
    return cmocka_run_group_tests_name("classroom", tests, set_up, tear_down);
}

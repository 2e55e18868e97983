/* make starters, make try, make grade: what students and teachers see. The whole session of
 * docs/teaching.md is "tests/check classroom". */
#define _DARWIN_C_SOURCE  /* mkdtemp on macOS */
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
               "right: hit 1|7/9",
               "grade tests/classroom/submissions/bert.c");
    char first[2000];
    snprintf(first, sizeof first, "%.1999s", said);
    setenv("SEED_TO_TRY", "7",
           1); /* another student number: other inputs, the same marks */
    expect_run(0, "bert.c: rt_hit_sphere: directions of any length|7/9",
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
        "anna.c                     9/9|gus.c: rt_reflect: unit vectors: ended by the "
        "system|hal.c: rt_reflect: unit vectors: ended by the system|lea.c: empty|none: "
        "no "
        "file with a name that ends in .c|wrote ",
        "grade \"$OLDPWD\"/class");
    assert_false(exists("/tmp/rt-gus-was-here"));
    assert_int_equal(run("cat b/marks.csv"), 0);
    assert_non_null(strstr(said, "name,chapter 1,of,chapter 2,of,"));
    assert_non_null(strstr(said, "\n\"anna.c\",9,9,0,0,"));
    assert_non_null(
        strstr(said, "\n\"gus.c\",0,0,0,0,0,0,0,0,0,0,0,2,0,0,0,0,0,0,0,0,0,0,0,0,\n"));
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
    assert_int_equal(
        run("tail -8 b/marks.csv | sed 's/,0,0,0,0,0,0,0,0,0,0,0,0,0,0//; s/,$//'"), 0);
    assert_string_equal(
        said, "\"mona.c\",8,8,0,0,0,0,0,0,0,0\n\"nils.c\",4,8,0,0,0,0,0,0,0,0\n"
              "\"olga.c\",0,0,11,11,0,0,0,0,0,0\n\"paul.c\",0,0,4,11,0,0,0,0,0,0\n"
              "\"quin.c\",0,0,0,0,7,7,4,4,0,0\n\"rosa.c\",0,0,0,0,3,7,1,4,0,0\n"
              "\"sven.c\",0,0,0,0,0,0,0,0,10,12\n\"tara.c\",0,0,0,0,0,0,0,0,12,12\n");
}

/* rt.h's own functions get all points, but for three that call what they would replace. */
static void test_rt_h_itself_is_right(void **state)
{
    (void)state;
    assert_int_equal(
        run("f='function left_out(name) { "
            "return name ~ /rt_hit_(sphere|box|triangle)$/ }'; "
            "awk \"$f\"'/^#ifndef rt_/ && !left_out($2) "
            "{ print \"#define \" $2 \" my_\" substr($2, 4) }' \"$TOP\"/rt.h >own.c; "
            "echo '#include \"rt.h\"' >>own.c; "
            "awk \"$f\"'/^#ifndef rt_/ { n = left_out($2) ? \"\" : $2 } "
            "n && /^static inline/ && index($0, \" \" n \"(\") { p = 1 } p { print } "
            "p && /^}/ { n = p = \"\" }' \"$TOP\"/rt.h >>own.c"),
        0);
    expect_run(0,
               "own.c                      5/5   7/7     -   9/9   4/4   2/2   9/9   8/8 "
               "11/11   "
               "7/7   4/4     -   66/66  uses rt__film, ",
               "grade \"$OLDPWD\"/own.c");
}

/* A file is compiled as its own program would be: its helpers, macros and main may be called like
 * anything of ours or of the C library's. */
static void test_no_name_clashes(void **state)
{
    (void)state;
    write_text("names.c",
               "#define RT_IMPLEMENTATION\n"
               "#define rt_reflect my_reflect\n"
               "#include \"rt.h\"\n"
               "#define in incident\n"
               "#define r normal\n"
               "static rt_vec3 take_vec(rt_vec3 a) { return a; }\n"
               "int write;\n"
               "float read(float a) { return a * (float)(M_PI / M_PI); }\n"
               "static inline rt_vec3 my_reflect(rt_vec3 in, rt_vec3 r)\n"
               "{ return take_vec(rt_sub(in, rt_scale(r, read(2 * rt_dot(in, r))))); }\n"
               "int main(void) { return 1; }\n");
    expect_run(0, "names.c                      -     -     -     -     -   2/2",
               "grade \"$OLDPWD\"/names.c");
    /* with older compilers, to which a global without a value is common to all files */
    assert_int_equal(run("cd \"$TOP\" && CC='cc -fcommon' BUILD=\"$OLDPWD\"/b "
                         "OUT=\"$OLDPWD\"/b/marks.csv "
                         "tests/classroom/run grade \"$OLDPWD\"/names.c"),
                     0);
    assert_non_null(strstr(said, " 2/2"));
}

/* 200 right answers, as they were once asked, know nothing of others. */
static void test_a_table_of_answers_gets_nothing(void **state)
{
    (void)state;
    assert_int_equal(
        run("{ echo '#define rt_encode my_encode'; echo '#include \"rt.h\"'; "
            "echo 'static const float table[][2] = {'; "
            "awk 'BEGIN { for (k = 0; k < 200; k++) "
            "printf \"{%.9g, %d},\\n\", k / 199, 255 * (k / 199) ^ (1 / 2.2) + 0.5 }'; "
            "echo '}; static inline unsigned char my_encode(float v, double g)'; "
            "echo '{ for (int k = 0; k < 200; k++) if (table[k][0] == v) "
            "return (unsigned char)table[k][1]; return (unsigned char)(g * 0); }'; } "
            ">table.c"),
        0);
    for (int seed = 0; seed < 3; seed++) {
        char number[2] = {(char)('0' + seed), '\0'};
        setenv("SEED_TO_TRY", number, 1);
        expect_run(0, "table.c                      -     -     -     -   0/4",
                   "grade \"$OLDPWD\"/table.c");
    }
    unsetenv("SEED_TO_TRY");
}

/* To leave out small t is not to start off the surface. */
static void test_small_t_counts(void **state)
{
    (void)state;
    assert_int_equal(run("sed 's/t > 0/t > 1e-3/g' "
                         "\"$TOP\"/tests/classroom/submissions/anna.c >skips.c"),
                     0);
    expect_run(0, "skips.c: rt_hit_sphere: from close to the surface|8/9",
               "grade \"$OLDPWD\"/skips.c");
}

/* What a teacher should know, of names that do nothing to a terminal. */
static void test_notes_and_names(void **state)
{
    (void)state;
    assert_int_equal(
        run("rm -rf odd && mkdir -p odd/two && cd odd && "
            "printf '#define rt_camera_ray mine\\n#include \"rt.h\"\\n/* rt__none */\\n"
            "static inline rt_ray mine(const rt_camera *c, int w, int h, float x, float "
            "y)\\n"
            "{ rt__film f = rt__film_of(c, w, h); return rt__film_ray(&f, x, y); }\\n'"
            " >private.c && for s in a 'a (2)' b \"$(printf "
            "'x\\ny\\302\\205\\377\\303\\251')\"; "
            "do cp \"$TOP\"/tests/classroom/submissions/jon.c \"$s.c\"; done && "
            "cp b.c two/new.c && sed 's/2 \\*/3 */' b.c >two/old.c && "
            "touch -d 2020-01-01 two/old.c"),
        0);
    expect_run(0,
               "a.c, a (2).c: of one student? both are listed|5/5  uses rt__film, "
               "rt__film_of, rt__film_ray\n|"
               "\nx\\x0ay\\xc2\\x85\\xff\303\251.c        -|"
               "two/old.c: rt_reflect is in a newer file|"
               "\ntwo                          -     -     -     -     -   2/2",
               "grade \"$OLDPWD\"/odd");
    assert_null(strstr(said, "rt__none"));
}

/* A copy of a right answer, with more at its end, in the folder "more". */
static void write_with(const char *name, const char *text)
{
    char line[200];
    snprintf(line, sizeof line,
             "mkdir -p more && cp \"$TOP\"/tests/classroom/submissions/jon.c more/%s.c",
             name);
    assert_int_equal(run(line), 0);
    snprintf(line, sizeof line, "more/%s.c", name);
    FILE *file = fopen(line, "a");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* What uses private names, but hides it. */
static void test_hidden_names_are_told(void **state)
{
    (void)state;
    write_with("a", "rt_ray look(const rt__film *, float, float)\n"
                    "    __attribute__((alias(\"rt__film_ray\")));\n");
    write_with("b", "# 1 \"rt.h\" 1\ntypedef rt__film hidden;\n");
    write_with("c", "/*\n*/ # \\\n/\\ \n* x */ 1 \"rt.h\" 1\ntypedef rt__film hidden;\n");
    write_with("d", "__asm__(\"nop\");\n");
    write_with("e", "/* Exercise #3:\n * # 1 \"rt.h\" */ // # 1 \"rt.h\"\n#line 9\n");
    expect_run(0,
               "2/2  uses rt__film, rt__film_ray\nb.c|2/2  uses a line marker\nc.c|"
               "2/2  uses a line marker\nd.c|2/2  uses __asm__\ne.c|2/2\nwrote",
               "grade \"$OLDPWD\"/more");
    assert_int_equal(run("rm -r more"), 0);
}

/* What does not compile, assemble or link is told why. */
static void test_why_it_does_not_compile(void **state)
{
    (void)state;
    write_with("links",
               "double nowhere(int x);\ndouble use(void) { return nowhere(1); }\n");
    write_with("assembles", "__asm__(\"no_such_thing\");\n");
    write_with("compiles", "#include __FILE__\n");
    expect_run(0,
               "links.c: does not compile\n         undefined reference to `nowhere|"
               "assembles.c: does not compile\n|no_such_thing'|"
               "compiles.c: does not compile\n         submission.c:6",
               "grade \"$OLDPWD\"/more");
    assert_int_equal(run("rm -r more; sed '/define rt_reflect/d; "
                         "$a #define rt_reflect my_reflect' "
                         "\"$TOP\"/tests/classroom/submissions/jon.c >late.c"),
                     0);
    expect_run(0, "late.c: #define rt_... must come before #include",
               "grade \"$OLDPWD\"/late.c");
}

/* Ctrl-C, which all get, leaves what is done so far. */
static void test_stopped(void **state)
{
    (void)state;
    assert_int_equal(
        run("rm -rf many && mkdir many && cd many && "
            "cp \"$TOP\"/tests/classroom/submissions/anna.c . && for i in 1 2 3 4 5 6 7 "
            "8 9; do "
            "cp \"$TOP\"/tests/classroom/submissions/eva.c endless$i.c; done"),
        0);
    expect_run(130, "anna.c                     9/9|wrote ",
               "grade \"$OLDPWD\"/many & b=$!; "
               "for i in $(seq 200); do pgrep -P $b grade >/dev/null && break; sleep "
               "0.05; done; "
               "sleep 3; kill -TERM $b $(pgrep -P $b grade); wait $b");
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
        cmocka_unit_test(test_rt_h_itself_is_right),
        cmocka_unit_test(test_no_name_clashes),
        cmocka_unit_test(test_a_table_of_answers_gets_nothing),
        cmocka_unit_test(test_small_t_counts),
        cmocka_unit_test(test_notes_and_names),
        cmocka_unit_test(test_hidden_names_are_told),
        cmocka_unit_test(test_why_it_does_not_compile),
        cmocka_unit_test(test_stopped),
        cmocka_unit_test(test_what_cannot_be_marked),
    };
    return cmocka_run_group_tests_name("classroom", tests, set_up, tear_down);
}

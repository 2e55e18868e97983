/* Marks students' routines: compiles each file with pupil.c, asks the program, in a sandbox, what
 * cases.h has to ask, and lets judge.h compare with rt.h. "make try" and "make grade" call it.
 *
 *     grade [--seed N] [--only NAME,NAME...] [--csv FILE] [--try] PATH
 *
 * PATH is a file of one submission or a folder of many: each file NAME.c, or each folder NAME with
 * files in it, is one. --try is for the student: one file, and every kind of input is listed.
 * Exit status: 0 if all was marked, with --try if all is right; 1 with --try if something is wrong,
 * 3 if it crashes or does not end; 2 wrong use, or nothing could be marked. */
#define _GNU_SOURCE
#include <dirent.h>
#include <sys/stat.h>

#include "judge.h"
#include "sandbox.h"

#ifdef __linux__
#define STATIC "-static" /* or it would have to open files to start */
#else
#define STATIC ""
#endif

enum { LARGEST = 1 << 20, CHAPTERS = 17, LONGEST = 300 };

static struct {
    uint32_t seed;
    const char *only, *csv, *cc, *folder;
    bool trying;
} options = {0, NULL, NULL, "cc", NULL, false};

typedef struct marks {
    char name[LONGEST];
    int good[CHAPTERS], all[CHAPTERS]; /* kinds of input, by chapter */
    bool handed_in[ROUTINES];
    bool dangerous; /* it crashed or did not end */
} marks;

/* ---- one routine ------------------------------------------------------------------------- */

/* Is this routine to be marked? */
static bool wanted(const char *name)
{
    const char *at = options.only;
    const size_t n = strlen(name);
    if (!at)
        return true;
    while ((at = strstr(at, name)) != NULL) {
        if ((at == options.only || at[-1] == ',') && (at[n] == ',' || at[n] == '\0'))
            return true;
        at += n;
    }
    return false;
}

/* Ask the program all inputs of a kind, and tell what is wrong with the first bad answer. */
static verdict ask(const char *program, int number, const char *who, bool tell)
{
    question q;
    char why[200], count[20];
    if (!make_question(&q, number, options.seed))
        return fprintf(stderr, "grade: not enough memory\n"), exit(2), WRONG;
    snprintf(count, sizeof count, "%d", q.count);
    char *const argv[] = {(char *)program, (char *)q.routine->name, count, NULL};
    const task t = {.argv = argv,
                    .confined = true,
                    .talks = options.trying,
                    .seconds = 3,
                    .in = (const char *)q.in,
                    .in_size = (size_t)(q.count * q.ins) * sizeof *q.in,
                    .out = (char *)q.out,
                    .out_size = (size_t)(q.count * q.outs) * sizeof *q.out};
    fflush(stdout);
    const bool ended = run_task(&t, why, sizeof why);
    const verdict v =
        judge(&q, ended, why, sizeof why, options.trying ? NULL : who, tell);
    forget(&q);
    return v;
}

/* ---- one submission ---------------------------------------------------------------------- */

/* The file, unless it is no text of a sensible size; why says why. */
static bool copy_file(const char *from, const char *to, char *why, size_t size)
{
    static char bytes[LARGEST + 1];
    struct stat info;
    if (lstat(from, &info) != 0)
        return snprintf(why, size, "%s", strerror(errno)), false;
    if (!S_ISREG(info.st_mode))
        return snprintf(why, size, "%s, not a file",
                        S_ISDIR(info.st_mode) ? "a folder" : "something else"),
               false;
    FILE *file = fopen(from, "rb");
    if (!file)
        return snprintf(why, size, "%s", strerror(errno)), false;
    const size_t n = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    if (n == 0 || n > LARGEST)
        return snprintf(why, size, "%s", n == 0 ? "empty" : "larger than a megabyte"),
               false;
    file = fopen(to, "wb");
    if (!file || fwrite(bytes, 1, n, file) != n || fclose(file) != 0) {
        fprintf(stderr, "grade: cannot write %s: %s\n", to, strerror(errno));
        exit(2);
    }
    return true;
}

/* What others wrote, without what could do something to a terminal. */
static char *printable(char *text)
{
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127)
            *c = '?';
    return text;
}

static void show_log(const char *path)
{
    char line[160];
    FILE *file = fopen(path, "r");
    for (int n = 0; file && n < 6 && fgets(line, sizeof line, file); n++) {
        line[strcspn(line, "\n")] = '\0';
        const char *at = strstr(line, "submission.c"); /* without the folders before it */
        if (at && line[0] != ' ')
            memmove(line, at, strlen(at) + 1);
        printf("         %s\n", printable(line));
    }
    if (file)
        fclose(file);
}

/* Which of the routines does the file replace? It says so to the preprocessor. */
static int find_routines(const char *defines, bool *found)
{
    char line[1000], name[100];
    int count = 0;
    FILE *file = fopen(defines, "r");
    while (file && fgets(line, sizeof line, file))
        for (int i = 0; i < ROUTINES; i++)
            if (sscanf(line, "#define %99s ", name) == 1 &&
                strcmp(name, routines[i].name) == 0) {
                found[i] = true;
                count++;
            }
    if (file)
        fclose(file);
    return count;
}

static bool compile(const char *how, const char *log, char *why, size_t size)
{
    char command[2000];
    snprintf(command, sizeof command,
             "exec %s -std=c99 -O1 -ffp-contract=off %s -I. "
             "'-DSUBMISSION=\"%s/submission.c\"' %s",
             options.cc, options.trying ? "-Wall" : "-w", options.folder, how);
    char *const argv[] = {"sh", "-c", command, NULL};
    const task t = {.argv = argv, .log = log, .seconds = 60};
    return run_task(&t, why, size);
}

static void mark_file(const char *path, const char *who, marks *m)
{
    char to[LONGEST + 40], log[LONGEST + 40], program[LONGEST + 40], check[LONGEST + 40],
        how[2 * LONGEST], why[200];
    bool found[ROUTINES] = {false};
    snprintf(to, sizeof to, "%s/submission.c", options.folder);
    snprintf(log, sizeof log, "%s/log", options.folder);
    snprintf(program, sizeof program, "%s/pupil", options.folder);
    unlink(to);
    unlink(program);
    if (!copy_file(path, to, why, sizeof why)) {
        printf("%s: %s\n", who, why);
        return;
    }
    snprintf(how, sizeof how, "-E -dM %s", to);
    const bool read = compile(how, log, why, sizeof why);
    if (find_routines(log, found) == 0 && read) {
        printf(
            "%s: replaces nothing: there is no line like #define rt_reflect my_reflect\n",
            who);
        return;
    }
    for (int i = 0; i < ROUTINES; i++) {
        if (found[i] && m->handed_in[i])
            printf("%s: %s was in another file: not marked again\n", who,
                   routines[i].name);
        found[i] = found[i] && !m->handed_in[i];
        m->handed_in[i] = m->handed_in[i] || found[i];
    }
    /* Where the line comes before rt.h, there is no rt_reflect of rt.h's, and the name is free. */
    snprintf(check, sizeof check, "%s/check.c", options.folder);
    FILE *file = fopen(check, "w");
    if (file) {
        fprintf(file, "#include \"submission.c\"\n");
        for (int i = 0; i < ROUTINES; i++)
            if (found[i])
                fprintf(file, "#undef %s\ntypedef int %s;\n", routines[i].name,
                        routines[i].name);
        fclose(file);
    }
    snprintf(how, sizeof how, "-fsyntax-only %s", check);
    const bool free_names = compile(how, log, why, sizeof why);
    snprintf(how, sizeof how, "%s -o %s tests/classroom/pupil.c -lm", STATIC, program);
    if (!compile(how, log, why, sizeof why)) {
        printf("%s: does not compile%s%s\n", who,
               strncmp(why, "no end", 6) == 0 ? ": " : "",
               strncmp(why, "no end", 6) == 0 ? why : "");
        show_log(log);
        return;
    }
    if (!free_names) {
        printf("%s: #define rt_... must come before #include \"rt.h\", and name a "
               "function of yours\n",
               who);
        return;
    }
    if (options.trying)
        show_log(log); /* warnings */
    for (int i = 0; i < ROUTINES; i++) {
        if (!found[i] || !wanted(routines[i].name))
            continue;
        if (options.trying)
            printf("%s, chapter %d\n", routines[i].name, routines[i].chapter);
        int right = 0, by_doing_nothing = 0, wrong = 0;
        for (int k = 0; k < KINDS; k++)
            if (strcmp(kinds[k].routine, routines[i].name) == 0) {
                const verdict v = ask(program, k, who, wrong == 0);
                wrong += v == WRONG || v == CRASHED || v == NO_END;
                m->dangerous = m->dangerous || v == CRASHED || v == NO_END;
                if (v == NO_END)
                    break; /* the rest would take as long */
                right += v == RIGHT;
                by_doing_nothing += v == RIGHT_BY_DOING_NOTHING;
            }
        m->good[routines[i].chapter] += marks_for(right, by_doing_nothing);
    }
}

static int only_c(const struct dirent *entry)
{
    const size_t n = strlen(entry->d_name);
    return entry->d_name[0] != '.' && n > 2 && strcmp(entry->d_name + n - 2, ".c") == 0;
}

static int visible_names(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static bool is_folder(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* A file, or all files in the folder of one student. */
static void mark_submission(const char *path, const char *name, marks *m)
{
    memset(m, 0, sizeof *m);
    snprintf(m->name, sizeof m->name, "%s", name);
    name = printable(m->name);
    if (is_folder(path)) {
        struct dirent **files;
        const int count = scandir(path, &files, only_c, alphasort);
        if (count <= 0)
            printf("%s: no file with a name that ends in .c\n", name);
        for (int i = 0; i < count; i++) {
            char inner[2 * LONGEST + 300], who[2 * LONGEST];
            snprintf(inner, sizeof inner, "%s/%s", path, files[i]->d_name);
            snprintf(who, sizeof who, "%s/%s", name, files[i]->d_name);
            mark_file(inner, printable(who), m);
            free(files[i]);
        }
        if (count >= 0)
            free(files);
    } else {
        mark_file(path, name, m);
    }
    for (int k = 0; k < KINDS; k++)
        for (int i = 0; i < ROUTINES; i++)
            if (strcmp(kinds[k].routine, routines[i].name) == 0 &&
                wanted(routines[i].name) && (m->handed_in[i] || options.only))
                m->all[routines[i].chapter]++;
}

/* ---- the table --------------------------------------------------------------------------- */

/* The next chapter that has routines to be marked; CHAPTERS after the last. */
static int next_chapter(int c)
{
    for (c++; c < CHAPTERS; c++)
        for (int i = 0; i < ROUTINES; i++)
            if (routines[i].chapter == c)
                return c;
    return c;
}

static void print_table(const marks *m, int count)
{
    printf("\n%-24s", "chapter");
    for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c))
        printf("%6d", c);
    printf("    total\n");
    for (int i = 0; i < count; i++) {
        int good = 0, all = 0;
        printf("%-24s", m[i].name);
        for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c)) {
            char cell[20] = "-";
            if (m[i].all[c] > 0)
                snprintf(cell, sizeof cell, "%d/%d", m[i].good[c], m[i].all[c]);
            printf("%6s", cell);
            good += m[i].good[c];
            all += m[i].all[c];
        }
        printf("  %3d/%d\n", good, all);
    }
}

static void print_quoted(FILE *file, const char *text)
{
    putc('"', file);
    /* a name that a spreadsheet would take for a formula is kept from it */
    if (strchr("=+-@", text[0]))
        putc('\'', file);
    for (; *text; text++) {
        if (*text == '"')
            putc('"', file);
        putc(*text, file);
    }
    putc('"', file);
}

/* Can the table be written? Asked before the work is done. */
static bool can_write_csv(void)
{
    struct stat info;
    char part[LONGEST + 30];
    if (stat(options.csv, &info) == 0 && !S_ISREG(info.st_mode))
        return errno = EINVAL, false;
    snprintf(part, sizeof part, "%s.%d", options.csv, (int)getpid());
    FILE *file = fopen(part, "w");
    if (file)
        fclose(file);
    unlink(part);
    return file != NULL;
}

/* An existing table is replaced by a complete new one. */
static bool write_csv(const marks *m, int count)
{
    char part[LONGEST + 30];
    snprintf(part, sizeof part, "%s.%d", options.csv, (int)getpid());
    FILE *file = fopen(part, "w");
    if (!file)
        return false;
    fprintf(file, "name");
    for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c))
        fprintf(file, ",chapter %d,of", c);
    fprintf(file, "\n");
    for (int i = 0; i < count; i++) {
        print_quoted(file, m[i].name);
        for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c))
            fprintf(file, ",%d,%d", m[i].good[c], m[i].all[c]);
        fprintf(file, "\n");
    }
    const bool good = !ferror(file);
    if ((fclose(file) == 0) & good && rename(part, options.csv) == 0)
        return true;
    unlink(part);
    return false;
}

/* ---- the program ------------------------------------------------------------------------- */

/* Does this machine compile and run what is right? Else no mark would mean anything. */
static void check_machine(void)
{
    char to[LONGEST + 40], log[LONGEST + 40], program[LONGEST + 40], how[2 * LONGEST],
        why[200] = "";
    snprintf(to, sizeof to, "%s/submission.c", options.folder);
    snprintf(log, sizeof log, "%s/log", options.folder);
    snprintf(program, sizeof program, "%s/pupil", options.folder);
    snprintf(how, sizeof how, "%s -o %s tests/classroom/pupil.c -lm", STATIC, program);
    FILE *file = fopen(to, "w");
    if (!file || fputs("#include \"rt.h\"\n", file) < 0 || fclose(file) != 0) {
        fprintf(stderr, "grade: cannot write %s: %s\n", to, strerror(errno));
        exit(2);
    }
    const float in[6] = {1, -1, 0, 0, 1, 0};
    float out[3] = {0, 0, 0};
    char *const argv[] = {program, "rt_reflect", "1", NULL};
    const task t = {.argv = argv,
                    .confined = true,
                    .seconds = 10,
                    .in = (const char *)in,
                    .in_size = sizeof in,
                    .out = (char *)out,
                    .out_size = sizeof out};
    if (!compile(how, log, why, sizeof why)) {
        fprintf(stderr, "grade: %s cannot compile rt.h itself here:\n", options.cc);
        show_log(log);
        exit(2);
    }
    if (!run_task(&t, why, sizeof why) || out[1] != 1) {
        fprintf(stderr, "grade: rt.h itself gives no right answer here: %s\n", why);
        exit(2);
    }
    fflush(stdout);
    const pid_t child = fork();
    int status = 1;
    if (child == 0)
        _exit(confine() ? 0 : 1);
    if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0)
        printf("note: this system cannot keep programs from files and other programs\n");
}

static bool parse(int argc, char **argv, const char **path)
{
    for (int i = 1; i < argc; i++) {
        char *end = "";
        if (strcmp(argv[i], "--try") == 0)
            options.trying = true;
        else if (strcmp(argv[i], "--seed") == 0 && i + 1 < argc) {
            const char *text = argv[++i];
            const unsigned long long seed = strtoull(text, &end, 10);
            if (*text < '0' || *text > '9' || *end || seed > UINT32_MAX)
                return fprintf(stderr,
                               "grade: --seed: '%s' is not a number up to 4294967295\n",
                               text),
                       false;
            options.seed = (uint32_t)seed;
        } else if (strcmp(argv[i], "--only") == 0 && i + 1 < argc)
            options.only = argv[++i];
        else if (strcmp(argv[i], "--csv") == 0 && i + 1 < argc)
            options.csv = argv[++i];
        else if (strcmp(argv[i], "--folder") == 0 && i + 1 < argc)
            options.folder = argv[++i];
        else if (argv[i][0] != '-' && !*path)
            *path = argv[i];
        else
            return fprintf(stderr, "grade: what is '%s'?\n", argv[i]), false;
    }
    int known = 0;
    for (int i = 0; i < ROUTINES; i++)
        known += options.only && wanted(routines[i].name);
    int names = options.only ? 1 : 0;
    for (const char *c = options.only; c && *c; c++)
        names += *c == ',';
    if (known != names)
        return fprintf(
                   stderr,
                   "grade: --only: '%s': names like rt_lambert, with commas between\n",
                   options.only),
               false;
    if (!*path || !**path || !options.folder)
        return fprintf(stderr,
                       "grade: which file, or folder of files? (make grade FILE=...)\n"),
               false;
    if (strlen(*path) >= LONGEST || (options.csv && strlen(options.csv) >= LONGEST))
        return fprintf(stderr, "grade: a name with more than %d letters\n", LONGEST - 1),
               false;
    return true;
}

int main(int argc, char **argv)
{
    const char *path = NULL;
    struct stat info;
    if (getenv("CC") && *getenv("CC"))
        options.cc = getenv("CC");
    if (!parse(argc, argv, &path))
        return 2;
    if (stat(path, &info) != 0)
        return fprintf(stderr, "grade: %s: %s\n", path, strerror(errno)), 2;
    if (options.csv && !can_write_csv())
        return fprintf(stderr, "grade: cannot write %s: %s\n", options.csv,
                       strerror(errno)),
               2;
    if (options.trying && !S_ISREG(info.st_mode))
        return fprintf(stderr, "grade: %s: %s, not a file\n", path,
                       S_ISDIR(info.st_mode) ? "a folder" : "something else"),
               2;

    struct dirent **entries = NULL;
    int count = 1;
    if (S_ISDIR(info.st_mode))
        count = scandir(path, &entries, visible_names, alphasort);
    marks *m = calloc((size_t)(count > 0 ? count : 1), sizeof *m);
    if (count <= 0 || !m)
        return fprintf(stderr, "grade: %s: nothing in it\n", path), 2;
    int n = 0;
    bool right = true;
    check_machine();
    for (int i = 0; i < count; i++) {
        char inner[2 * LONGEST];
        const char *name = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
        snprintf(inner, sizeof inner, entries ? "%s/%s" : "%s", path,
                 entries ? entries[i]->d_name : "");
        if (entries && !only_c(entries[i]) && !is_folder(inner)) {
            printf("%s: left out, its name does not end in .c\n",
                   printable(entries[i]->d_name));
            continue;
        }
        mark_submission(inner, entries ? entries[i]->d_name : name, &m[n]);
        for (int c = 1; c < CHAPTERS; c++)
            right = right && m[n].good[c] == m[n].all[c];
        n++;
    }
    int asked = 0;
    for (int c = 1; c < CHAPTERS; c++)
        asked += m[0].all[c];
    if (options.trying && right && asked > 0)
        return printf("all right\n"), 0;
    if (options.trying)
        return m[0].dangerous ? 3 : 1;
    print_table(m, n);
    if (options.csv && !write_csv(m, n))
        return fprintf(stderr, "grade: cannot write %s: %s\n", options.csv,
                       strerror(errno)),
               2;
    return 0;
}

/* Marks students' routines: compiles each file by itself, links it with pupil.c, asks the program,
 * in a sandbox, what cases.h has to ask, and lets judge.h compare with rt.h. "make try" and "make
 * grade" call it.
 *
 *     grade [--seed N] [--only NAME,NAME...] [--csv FILE] [--try] --folder FOLDER PATH
 *
 * PATH is a file of one submission or a folder of many: each file NAME.c, or each folder NAME with
 * files in it, is one. As many are marked at a time as there are cores. --try is for the student:
 * one file, and every kind of input is listed. FOLDER is for what is made on the way.
 * Exit status: 0 if all was marked, with --try if all is right; 1 with --try if something is wrong,
 * 3 if it crashes or does not end; 2 wrong use, or nothing could be marked; 130 if stopped. */
#define _GNU_SOURCE
#include <ctype.h>
#include <dirent.h>
#include <locale.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <wchar.h>

#include "judge.h"
#include "sandbox.h"

/* Keep to itself all that a compiled submission defines, but for the pointers to its routines. */
#ifdef __APPLE__ /* where there is no objcopy; not tried yet */
#define HIDE                                                                             \
    "ld -r -exported_symbol '_rt__yours_*' -o \"$W/all.o\" \"$W/submission.o\" && "      \
    "mv \"$W/all.o\" \"$W/submission.o\""
#else
#define HIDE "objcopy -w -G 'rt__yours_*' \"$W/submission.o\""
#endif

#ifdef __linux__
#define STATIC "-static" /* or it would have to open files to start */
#else
#define STATIC ""
#endif

enum {
    LARGEST = 1 << 20, /* bytes of a file */
    LONGEST = 300,     /* bytes of a name */
    SAFE = 8 * LONGEST,
    PATH = 3 * LONGEST,
    CHAPTERS = 17,
    ALL_SECONDS = 30, /* for all of a submission */
    COMPILE_SECONDS = 10,
    ASK_SECONDS = 3 /* for a kind of input */
};

static struct {
    uint32_t seed;
    const char *only, *csv, *folder;
    bool trying, seeded;
} options;

typedef struct marks {
    char name[LONGEST];
    int good[CHAPTERS], all[CHAPTERS]; /* kinds of input, by chapter */
    bool handed_in[ROUTINES];
    char note[200]; /* what a teacher should know */
    bool dangerous; /* it crashed or did not end */
    bool done;
    pid_t marker; /* the process that marks it now */
} marks;

/* ---- others' words, made safe for a terminal and a table -------------------------------- */

/* Does it show, and leave the direction of writing alone? */
static bool visible(wchar_t c)
{
    return wcwidth(c) >= 0 && c != 0xad && c != 0x61c && c != 0x180e && c != 0xfeff &&
           !(c >= 0x200b && c <= 0x200f) && !(c >= 0x2028 && c <= 0x202e) &&
           !(c >= 0x2060 && c <= 0x206f) && !(c >= 0xfff9 && c <= 0xfffb) &&
           !(c >= 0xe0000 && c <= 0xe0fff);
}

/* A copy in which each byte that is not part of a visible letter is \xNN; returns how many
 * columns it takes. */
static int make_safe(char *to, size_t size, const char *from)
{
    int columns = 0;
    while (*from && size > 8) {
        wchar_t c = 0;
        mbstate_t start;
        memset(&start, 0, sizeof start);
        const size_t bytes = mbrtowc(&c, from, strlen(from), &start);
        if (bytes <= 4 && visible(c)) {
            memcpy(to, from, bytes);
            from += bytes, to += bytes, size -= bytes;
            columns += wcwidth(c);
        } else {
            for (size_t i = 0; i < (bytes <= 4 ? bytes : 1) && size > 4; i++) {
                snprintf(to, size, "\\x%02x", (unsigned char)*from++);
                to += 4, size -= 4;
                columns += 4;
            }
        }
    }
    *to = '\0';
    return columns;
}

/* ---- one routine ------------------------------------------------------------------------- */

static double all_end; /* of the time for this submission */

/* This many seconds, or what is left of the submission's time. */
static double at_most(double seconds)
{
    const double left = all_end - clock_seconds();
    return left < seconds ? (left > 0 ? left : 0) : seconds;
}

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
                    .seconds = at_most(ASK_SECONDS),
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

/* ---- one file ---------------------------------------------------------------------------- */

/* The path of a file in the folder for what is made on the way. */
static const char *made(const char *name)
{
    static char paths[4][PATH];
    static int next;
    char *const path = paths[next++ % 4];
    snprintf(path, PATH, "%s/%s", options.folder, name);
    return path;
}

static void write_made(const char *name, const char *bytes, size_t size)
{
    FILE *file = fopen(made(name), "wb");
    const bool good = file && fwrite(bytes, 1, size, file) == size;
    if (!file || (fclose(file) != 0) | !good) {
        fprintf(stderr, "grade: cannot write %s: %s\n", made(name), strerror(errno));
        exit(2);
    }
}

/* Add to a list with commas, once; dots when it is full. */
static void add_note(char *note, size_t size, const char *text)
{
    const size_t n = strlen(note);
    if (strstr(note, text) || (n > 3 && strcmp(note + n - 3, "...") == 0))
        return;
    if (n + strlen(text) + 8 > size)
        text = "...";
    snprintf(note + n, size - n, "%s%s", n > 0 ? ", " : "", text);
}

static const char *skip_blanks(const char *at)
{
    for (;;) {
        const char *const end = strncmp(at, "/*", 2) == 0 ? strstr(at + 2, "*/") : NULL;
        if (end)
            at = end + 2;
        else if (*at && strchr(" \t\v\f\r", *at))
            at++;
        else
            return at;
    }
}

/* Is there a line like # 1 "rt.h" 1? To the compiler, what follows it is in that file, so
 * read_preprocessed() would not know whose it is. The text is changed: a line that goes on with \
 * becomes one. */
static bool has_line_marker(char *text)
{
    char *to = text;
    for (const char *from = text; *from;) {
        const size_t blanks = *from == '\\' ? strspn(from + 1, " \t\v\f\r") : 0;
        if (*from == '\\' && from[1 + blanks] == '\n')
            from += 2 + blanks;
        else
            *to++ = *from++;
    }
    *to = '\0';
    for (const char *line = text; line; line = strchr(line, '\n')) {
        line += *line == '\n' ? 1 : 0;
        const char *at = skip_blanks(line);
        const size_t sign = *at == '#' ? 1 : strncmp(at, "%:", 2) == 0 ? 2 : 0;
        if (sign > 0 && isdigit((unsigned char)*skip_blanks(at + sign)))
            return true;
    }
    return false;
}

/* The file becomes submission.c, unless it is no text of a sensible size; why says why. */
static bool copy_file(const char *from, char *note, size_t note_size, char *why,
                      size_t size)
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
    write_made("submission.c", bytes, n);
    for (size_t i = 0; i < n; i++)
        bytes[i] = bytes[i] ? bytes[i] : ' '; /* as the compiler reads it */
    bytes[n] = '\0';
    if (has_line_marker(bytes))
        add_note(note, note_size, "a line marker");
    return true;
}

/* The first lines that say what is wrong, without the folders before names, and without those that
 * only lead there. */
static void show_log(void)
{
    char line[400], shown[160], before[160] = "", safe[SAFE];
    FILE *file = fopen(made("log"), "r");
    for (int n = 0; file && n < 6 && fgets(line, sizeof line, file);) {
        line[strcspn(line, "\n")] = '\0';
        const char *const own = strstr(line, "submission.c");
        const char *const link = strstr(line, "undefined reference");
        snprintf(shown, sizeof shown, "%s",
                 link                    ? link
                 : own && line[0] != ' ' ? own
                                         : line);
        if (strstr(line, "included from ") || strstr(line, "   from ") ||
            strstr(line, ": in function") || strcmp(shown, before) == 0)
            continue;
        snprintf(before, sizeof before, "%s", shown);
        make_safe(safe, sizeof safe, shown);
        printf("         %s\n", safe);
        n++;
    }
    if (file)
        fclose(file);
}

/* Run a command of the shell in which $CC is the compiler and $W the folder for what is made;
 * what it prints goes to the file log. */
static bool build(const char *command, char *why, size_t size)
{
    char *const argv[] = {"sh", "-c", (char *)command, NULL};
    char log[PATH];
    snprintf(log, sizeof log, "%s", made("log"));
    setenv("W", options.folder, 1);
    const task t = {.argv = argv, .log = log, .seconds = at_most(COMPILE_SECONDS)};
    return run_task(&t, why, size);
}

/* What a teacher should know of a line: private names of rt.h, also in "...", where alias("rt__...")
 * has them; assembly, which may hide anything. */
static void find_private(const char *line, char *note, size_t size)
{
    char name[60];
    for (const char *at = line; *at;) {
        size_t n = 0;
        while (isalnum((unsigned char)at[n]) || at[n] == '_')
            n++;
        snprintf(name, sizeof name, "%.*s", (int)n, at);
        if (strncmp(name, "rt__", 4) == 0 || strcmp(name, "asm") == 0 ||
            strcmp(name, "__asm") == 0 || strcmp(name, "__asm__") == 0)
            add_note(note, size, name);
        at += n > 0 ? n : 1;
    }
}

/* What the preprocessor makes of a submission (-E -dD): which of the routines it replaces, and what
 * of its own lines a teacher should know: private names of rt.h, files of others. */
static int read_preprocessed(bool *found, char *note, size_t size)
{
    enum { DEEPEST = 300 };
    char line[4000], name[1000], safe[SAFE];
    int depth = 0, count = 0, flag, own = 0; /* the depth up to which lines are its own */
    bool whole = true;                       /* is this the beginning of a line? */
    FILE *file = fopen(made("log"), "r");
    for (; file && fgets(line, sizeof line, file); whole = strchr(line, '\n') != NULL) {
        if (whole && sscanf(line, "# %*d \"%999[^\"]\" %d", name, &flag) == 2) {
            depth += flag == 1 ? 1 : flag == 2 ? -1 : 0;
            const bool system = strstr(strrchr(line, '"'), " 3") != NULL;
            const char *last = strrchr(name, '/') ? strrchr(name, '/') + 1 : name;
            if (flag == 1 && own == depth - 1 && !system && strcmp(last, "rt.h") != 0 &&
                name[0] != '<') {
                own = depth; /* a file of others: as if it was its own */
                make_safe(safe, sizeof safe, name);
                add_note(note, size, safe);
            } else if (own > depth) {
                own = depth;
            }
            continue;
        }
        for (int i = 0; whole && i < ROUTINES; i++) {
            if (sscanf(line, "#define %999s ", name) == 1 &&
                strcmp(name, routines[i].name) == 0)
                found[i] = true;
            if (sscanf(line, "#undef %999s", name) == 1 &&
                strcmp(name, routines[i].name) == 0)
                found[i] = false;
        }
        if (depth == own)
            find_private(line, note, size);
    }
    if (file)
        fclose(file);
    for (int i = 0; i < ROUTINES; i++)
        count += found[i];
    return count;
}

/* yours.h: for these routines, the student's. */
static void write_yours(const bool *found)
{
    char text[100 * ROUTINES] = "";
    size_t n = 0;
    for (int i = 0; i < ROUTINES; i++)
        if (!found || found[i])
            n += (size_t)snprintf(text + n, sizeof text - n, "#define %s rt__its_%s\n",
                                  routines[i].name, routines[i].name + 3);
    n += (size_t)snprintf(text + n, sizeof text - n,
                          "#include \"tests/classroom/yours.h\"\n");
    write_made("yours.h", text, n);
}

/* student.c: the file as it is, and after it a pointer to each routine. Where the line #define comes
 * after rt.h, there is a rt_reflect of rt.h's, and the name is not free. */
static void write_student(const bool *found)
{
    char text[200 * ROUTINES] = "#include \"submission.c\"\n";
    size_t n = strlen(text);
    for (int i = 0; i < ROUTINES; i++) {
        const char *name = routines[i].name;
        if (found[i])
            n += (size_t)snprintf(text + n, sizeof text - n,
                                  "__typeof__(%s) *const rt__yours_%s = %s;\n"
                                  "#undef %s\n"
                                  "typedef int %s;\n",
                                  name, name, name, name, name);
    }
    write_made("student.c", text, n);
}

#define TO_OBJECT "$CC -O1 -ffp-contract=off -fno-common -w -I. -c -o"
#define ALONE TO_OBJECT " \"$W/alone.o\" \"$W/submission.c\""
#define WITH_POINTERS TO_OBJECT " \"$W/submission.o\" \"$W/student.c\""
/* None of the student's names but the pointers are seen by the program that it is linked with: not
 * their main, and no function that is called like one of the C library's. */
#define LINK                                                                             \
    HIDE " && "                                                                          \
         "$CC " STATIC " -o \"$W/pupil\" \"$PUPIL\" \"$W/submission.o\" -lm"
#define COMPILE WITH_POINTERS " && " LINK
#define PREPROCESS "exec $CC -E -dD -I. \"$W/submission.c\""
#define WARN "exec $CC -fsyntax-only -Wall -I. \"$W/submission.c\""

static void say(const char *who, const char *format, ...)
{
    va_list rest;
    va_start(rest, format);
    printf("%s: ", who);
    vprintf(format, rest);
    printf("\n");
    va_end(rest);
}

/* Why it does not compile: in the words of the compiler, the assembler or the linker, or it was the
 * time or the size. */
static void tell_errors(const char *who, const char *why)
{
    char again[200];
    const bool told = strncmp(why, "it ended by itself", 18) == 0;
    const bool alone = told && build(ALONE, again, sizeof again);
    if (alone && !build(WITH_POINTERS, again, sizeof again)) {
        say(who,
            "#define rt_... must come before #include \"rt.h\", and name a function of "
            "yours");
        return;
    }
    if (alone)
        build(LINK, again, sizeof again);
    say(who, "does not compile%s%s", told ? "" : ": ", told ? "" : why);
    if (told)
        show_log();
}

/* Compile it to the program pupil, as its own program would be; false if it cannot be. */
static bool compile(const char *who, const bool *found)
{
    char why[200];
    write_student(found);
    write_yours(found);
    if (!build(COMPILE, why, sizeof why))
        return tell_errors(who, why), false;
    if (options.trying && build(WARN, why, sizeof why))
        show_log(); /* warnings */
    return true;
}

/* Ask all kinds of input of a routine; how many points it gets. */
static int mark_routine(const routine *r, const char *who, marks *m)
{
    int right = 0, by_doing_nothing = 0, wrong = 0;
    if (options.trying)
        printf("%s, chapter %d\n", r->name, r->chapter);
    for (int k = 0; k < KINDS && at_most(ASK_SECONDS) > 0; k++)
        if (strcmp(kinds[k].routine, r->name) == 0) {
            const verdict v = ask(made("pupil"), k, who, wrong == 0);
            wrong += v == WRONG || v == CRASHED || v == NO_END;
            m->dangerous = m->dangerous || v == CRASHED || v == NO_END;
            if (v == NO_END)
                break; /* the rest would take as long */
            right += v == RIGHT;
            by_doing_nothing += v == RIGHT_BY_DOING_NOTHING;
        }
    return marks_for(right, by_doing_nothing);
}

static void mark_file(const char *path, const char *who, marks *m)
{
    char why[200], note[sizeof m->note - 8] = ""; /* a full one fits, too */
    bool found[ROUTINES] = {false};
    unlink(made("pupil"));
    if (!copy_file(path, note, sizeof note, why, sizeof why)) {
        say(who, "%s", why);
        return;
    }
    const bool read = build(PREPROCESS, why, sizeof why);
    const int count = read_preprocessed(found, note, sizeof note);
    if (!read) {
        tell_errors(who, why);
        return;
    }
    if (count == 0) {
        say(who, "replaces nothing: there is no line like #define rt_reflect my_reflect");
        return;
    }
    for (int i = 0; i < ROUTINES; i++) {
        if (found[i] && m->handed_in[i])
            say(who, "%s is in a newer file: that one counts", routines[i].name);
        found[i] = found[i] && !m->handed_in[i];
        m->handed_in[i] = m->handed_in[i] || found[i];
    }
    if (*note) {
        say(who, "note: uses %s", note);
        add_note(m->note, sizeof m->note, note);
    }
    if (!compile(who, found))
        return;
    for (int i = 0; i < ROUTINES; i++)
        if (found[i] && wanted(routines[i].name))
            m->good[routines[i].chapter] += mark_routine(&routines[i], who, m);
}

/* ---- one submission ---------------------------------------------------------------------- */

static bool has_ending(const char *name)
{
    const size_t n = strlen(name);
    return n > 2 && strcmp(name + n - 2, ".c") == 0;
}

static int only_c(const struct dirent *entry)
{
    return entry->d_name[0] != '.' && has_ending(entry->d_name);
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

static bool is_newer(const char *folder, const char *a, const char *b)
{
    char path[2][PATH];
    struct stat info[2];
    snprintf(path[0], PATH, "%s/%s", folder, a);
    snprintf(path[1], PATH, "%s/%s", folder, b);
    return lstat(path[0], &info[0]) == 0 && lstat(path[1], &info[1]) == 0 &&
           (info[0].st_mtim.tv_sec != info[1].st_mtim.tv_sec
                ? info[0].st_mtim.tv_sec > info[1].st_mtim.tv_sec
                : info[0].st_mtim.tv_nsec > info[1].st_mtim.tv_nsec);
}

/* All files in the folder of one student, the newest first: of a routine that several replace, that
 * one counts. */
static void mark_folder(const char *path, const char *who, marks *m)
{
    struct dirent **files;
    const int count = scandir(path, &files, only_c, alphasort);
    if (count <= 0)
        say(who, "no file with a name that ends in .c");
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && is_newer(path, files[k]->d_name, files[k - 1]->d_name);
             k--) {
            struct dirent *const other = files[k];
            files[k] = files[k - 1];
            files[k - 1] = other;
        }
    for (int i = 0; i < count; i++) {
        char inner[PATH], name[PATH], safe[SAFE];
        snprintf(inner, sizeof inner, "%s/%s", path, files[i]->d_name);
        snprintf(name, sizeof name, "%s/%s", m->name, files[i]->d_name);
        make_safe(safe, sizeof safe, name);
        if (at_most(ALL_SECONDS) > 0)
            mark_file(inner, safe, m);
        free(files[i]);
    }
    if (count >= 0)
        free(files);
}

static void mark_submission(const char *path, marks *m)
{
    char who[SAFE];
    make_safe(who, sizeof who, m->name);
    all_end = clock_seconds() + ALL_SECONDS;
    if (is_folder(path))
        mark_folder(path, who, m);
    else
        mark_file(path, who, m);
    if (at_most(ALL_SECONDS) <= 0)
        say(who, "its %d seconds are over: what is left gets no points", ALL_SECONDS);
    for (int k = 0; k < KINDS; k++)
        for (int i = 0; i < ROUTINES; i++)
            if (strcmp(kinds[k].routine, routines[i].name) == 0 &&
                wanted(routines[i].name) && (m->handed_in[i] || options.only))
                m->all[routines[i].chapter]++;
    m->done = true;
}

/* ---- many -------------------------------------------------------------------------------- */

static volatile sig_atomic_t stopped;

static void stop(int signal_number)
{
    (void)signal_number;
    stopped = 1;
}

static void sum(const marks *m, int *good, int *all)
{
    *good = *all = 0;
    for (int c = 1; c < CHAPTERS; c++) {
        *good += m->good[c];
        *all += m->all[c];
    }
}

/* In a process and a folder of its own; what it says goes to a file there. */
static void start_marking(const char *path, marks *m, int number)
{
    char folder[LONGEST + 20];
    snprintf(folder, sizeof folder, "%s/%d", options.folder, number);
    fflush(stdout);
    const pid_t marker = fork();
    if (marker != 0) {
        m->marker = marker; /* it shares m, and must not say who it is */
        return;
    }
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    options.folder = folder;
    if (mkdir(folder, 0700) != 0 || !freopen(made("said"), "w", stdout)) {
        fprintf(stderr, "grade: cannot write %s: %s\n", folder, strerror(errno));
        _exit(2);
    }
    mark_submission(path, m);
    fflush(stdout);
    _exit(ferror(stdout) ? 2 : 0);
}

/* One line for each that is done, on standard error: they do not come in the order of their names. */
static void tell_progress(const marks *m, int done, int count, double seconds)
{
    char name[SAFE];
    int good, all;
    sum(m, &good, &all);
    make_safe(name, sizeof name, m->name);
    fprintf(stderr, "%d of %d: %s %d/%d", done, count, name, good, all);
    if (done < count)
        fprintf(stderr, ", about %.0f s left", seconds / done * (count - done));
    fprintf(stderr, "\n");
}

static void tell_unmarked(const marks *m)
{
    char name[SAFE];
    make_safe(name, sizeof name, m->name);
    fprintf(stderr, "grade: could not mark %s\n", name);
}

/* Mark all; as many at a time as there are cores. */
static void mark_all(const char *const *paths, marks *m, int count)
{
    const double start = clock_seconds();
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    int next = 0, now = 0, done = 0;
    signal(SIGINT, stop);
    signal(SIGTERM, stop);
    while (now > 0 || (next < count && !stopped)) {
        for (; now < cores && next < count && !stopped; now++, next++)
            start_marking(paths[next], &m[next], next);
        for (int i = 0; i < next; i++) {
            if (m[i].marker == 0)
                continue;
            int status = 1;
            if (stopped)
                kill(m[i].marker, SIGTERM);
            if (m[i].marker > 0 && waitpid(m[i].marker, &status, WNOHANG) == 0)
                continue;
            m[i].marker = 0;
            now--;
            m[i].done = m[i].done && status == 0;
            if (m[i].done)
                tell_progress(&m[i], ++done, count, clock_seconds() - start);
            else if (!stopped)
                tell_unmarked(&m[i]);
        }
        nanosleep(&(struct timespec){0, 5000000}, NULL);
    }
}

/* What was said about each, in the order of their names. */
static void print_said(int count)
{
    for (int i = 0; i < count; i++) {
        char name[40], bytes[4096];
        snprintf(name, sizeof name, "%d/said", i);
        FILE *file = fopen(made(name), "r");
        size_t n;
        while (file && (n = fread(bytes, 1, sizeof bytes, file)) > 0)
            fwrite(bytes, 1, n, stdout);
        if (file)
            fclose(file);
    }
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
    enum { WIDEST = 40 };
    char name[SAFE];
    int wide = 24;
    for (int i = 0; i < count; i++) {
        const int columns = m[i].done ? make_safe(name, sizeof name, m[i].name) : 0;
        wide = columns > wide && columns <= WIDEST ? columns : wide;
    }
    printf("\n%-*s", wide, "chapter");
    for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c))
        printf("%6d", c);
    printf("    total\n");
    for (int i = 0; i < count; i++) {
        int good, all;
        if (!m[i].done)
            continue;
        sum(&m[i], &good, &all);
        const int columns = make_safe(name, sizeof name, m[i].name);
        printf("%s%s%*s", name, columns > wide ? "\n" : "",
               columns > wide ? wide : wide - columns, "");
        for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c)) {
            char cell[20] = "-";
            if (m[i].all[c] > 0)
                snprintf(cell, sizeof cell, "%d/%d", m[i].good[c], m[i].all[c]);
            printf("%6s", cell);
        }
        printf("  %3d/%d%s%s\n", good, all, *m[i].note ? "  uses " : "", m[i].note);
    }
}

static void print_quoted(FILE *file, const char *name)
{
    char text[SAFE];
    make_safe(text, sizeof text, name);
    putc('"', file);
    /* a name that a spreadsheet would take for a formula is kept from it */
    if (*text && strchr("=+-@", text[0]))
        putc('\'', file);
    for (const char *c = text; *c; c++) {
        if (*c == '"')
            putc('"', file);
        putc(*c, file);
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
    fprintf(file, ",uses\n");
    for (int i = 0; i < count; i++) {
        if (!m[i].done)
            continue;
        print_quoted(file, m[i].name);
        for (int c = next_chapter(0); c < CHAPTERS; c = next_chapter(c))
            fprintf(file, ",%d,%d", m[i].good[c], m[i].all[c]);
        putc(',', file);
        if (*m[i].note)
            print_quoted(file, m[i].note);
        putc('\n', file);
    }
    const bool good = !ferror(file);
    if ((fclose(file) == 0) & good && rename(part, options.csv) == 0)
        return true;
    unlink(part);
    return false;
}

/* ---- the program ------------------------------------------------------------------------- */

/* Does this machine compile and run what is right? Else no mark would mean anything. The program
 * that asks (pupil.c) is compiled here, for all. */
static void check_machine(void)
{
    static const char file[] = "#define rt_reflect mine\n"
                               "#include \"rt.h\"\n"
                               "static rt_vec3 mine(rt_vec3 i, rt_vec3 n)\n"
                               "{ return rt_sub(i, rt_scale(n, 2 * rt_dot(i, n))); }\n";
    char why[200];
    bool found[ROUTINES] = {false};
    for (int i = 0; i < ROUTINES; i++)
        found[i] = strcmp(routines[i].name, "rt_reflect") == 0;
    setenv("PUPIL", made("pupil.o"), 1);
    write_made("submission.c", file, sizeof file - 1);
    write_student(found);
    write_yours(NULL);
    all_end = clock_seconds() + ALL_SECONDS;
    if (!build(
            "exec $CC -O2 -ffp-contract=off -w -I. \"-DSUBMISSION=\\\"$W/yours.h\\\"\" "
            "-c -o \"$PUPIL\" tests/classroom/pupil.c",
            why, sizeof why) ||
        !build(COMPILE, why, sizeof why)) {
        fprintf(stderr, "grade: %s cannot compile rt.h itself here: %s\n", getenv("CC"),
                why);
        show_log();
        exit(2);
    }
    const float in[6] = {1, -1, 0, 0, 1, 0};
    float out[3] = {0, 0, 0};
    char *const argv[] = {(char *)made("pupil"), "rt_reflect", "1", NULL};
    const task t = {.argv = argv,
                    .confined = true,
                    .seconds = 10,
                    .in = (const char *)in,
                    .in_size = sizeof in,
                    .out = (char *)out,
                    .out_size = sizeof out};
    if (!run_task(&t, why, sizeof why) || out[1] != 1) {
        fprintf(stderr, "grade: what is right gives no right answer here: %s\n", why);
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
            options.seeded = true;
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
    if (strlen(*path) >= LONGEST || strlen(options.folder) >= LONGEST ||
        (options.csv && strlen(options.csv) >= LONGEST))
        return fprintf(stderr, "grade: a name with more than %d letters\n", LONGEST - 1),
               false;
    return true;
}

/* The length of a name without .c. */
static size_t bare(const char *name)
{
    return strlen(name) - (has_ending(name) ? 2 : 0);
}

/* The same without a number of its own: "anna (2)", "anna_2", "anna-2". Is that number in brackets,
 * as a browser gives it to a copy? */
static size_t stem(const char *name, bool *copy)
{
    const size_t n = bare(name);
    size_t end = n;
    *copy = n > 0 && name[n - 1] == ')';
    end -= *copy ? 1 : 0;
    while (end > 0 && isdigit((unsigned char)name[end - 1]))
        end--;
    if (*copy && end > 0 && name[end - 1] == '(')
        end--;
    else
        *copy = false;
    const size_t digits = end;
    while (end > 0 && strchr(" _-", name[end - 1]))
        end--;
    return end == 0 || digits == n || (!*copy && end == digits) ? n : end;
}

/* Files that look as if one student had handed in both: only the teacher can know. */
static void tell_doubles(const marks *m, int count)
{
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            bool copy, other_copy;
            const size_t n = stem(m[i].name, &copy), other = stem(m[k].name, &other_copy);
            const bool original = n == bare(m[k].name);
            const bool two_copies = k < i && copy && other_copy && n == other;
            if (i == k || !(original || two_copies) ||
                strncmp(m[i].name, m[k].name, n) != 0)
                continue;
            char first[SAFE], second[SAFE];
            make_safe(first, sizeof first, m[k].name);
            make_safe(second, sizeof second, m[i].name);
            printf("%s, %s: of one student? both are listed\n", first, second);
            break;
        }
}

/* The names of all submissions in a folder, and where they are. */
static int list_folder(const char *path, marks *m, const char **paths,
                       struct dirent **entries, int count)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        char inner[PATH], safe[SAFE];
        snprintf(inner, sizeof inner, "%s/%s", path, entries[i]->d_name);
        if (only_c(entries[i]) || is_folder(inner)) {
            snprintf(m[n].name, sizeof m[n].name, "%s", entries[i]->d_name);
            paths[n++] = strdup(inner);
            continue;
        }
        make_safe(safe, sizeof safe, entries[i]->d_name);
        printf("%s: left out, its name does not end in .c\n", safe);
    }
    return n;
}

/* For the student: one file, and every kind of input. */
static int try(const char *path, marks *m)
{
    int good, all;
    mark_submission(path, m);
    sum(m, &good, &all);
    if (good == all && all > 0)
        return printf("all right\n"), 0;
    return m->dangerous ? 3 : 1;
}

int main(int argc, char **argv)
{
    const char *path = NULL;
    struct stat info;
    setlocale(LC_CTYPE, "C.UTF-8");
    setenv("CC", "cc", getenv("CC") && !*getenv("CC"));
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
    const size_t room = (size_t)(count > 0 ? count : 1);
    /* shared with the processes that mark */
    marks *m = mmap(NULL, room * sizeof *m, PROT_READ | PROT_WRITE,
                    MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    const char **paths = calloc(room, sizeof *paths);
    if (count <= 0 || m == MAP_FAILED || !paths)
        return fprintf(stderr, "grade: %s: nothing in it\n", path), 2;
    check_machine();
    if (!options.trying && !options.seeded) /* inputs that no student has seen */
        options.seed = rt_hash((uint32_t)time(NULL)) % 1000000;
    paths[0] = path;
    snprintf(m[0].name, sizeof m[0].name, "%s",
             strrchr(path, '/') ? strrchr(path, '/') + 1 : path);
    if (options.trying)
        return try(path, m);
    if (entries)
        count = list_folder(path, m, paths, entries, count);
    printf("the inputs are those of SEED=%u\n", (unsigned)options.seed);
    tell_doubles(m, count);
    mark_all(paths, m, count);
    print_said(count);
    print_table(m, count);
    if (options.csv && !write_csv(m, count))
        return fprintf(stderr, "grade: cannot write %s: %s\n", options.csv,
                       strerror(errno)),
               2;
    return stopped ? 130 : 0;
}

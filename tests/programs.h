/* The demos as programs, for the tests of the command line: they run in a folder of their own
 * under /tmp. BUILD in the environment says where the programs are; build/ if it does not. */
#ifndef PROGRAMS_H
#define PROGRAMS_H

#include <ftw.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "test.h"

static char demos[4096], folder[] = "/tmp/rt-test-XXXXXX";
static char said[65536]; /* what the last program printed, on both channels */

static inline int run(const char *command)
{
    char line[8192];
    snprintf(line, sizeof line, "{ %s ; } 2>&1", command);
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    const size_t n = fread(said, 1, sizeof said - 1, pipe);
    said[n] = '\0';
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* Run a demo; expect this status and all of these words ("|" between) in what it says. */
static inline void expect(int status, const char *words, const char *arguments)
{
    char command[7000], list[500];
    snprintf(command, sizeof command, "\"$DEMOS\"/%s", arguments);
    const int actual = run(command);
    if (actual != status)
        fail_msg("%s: exit status %d, expected %d; it said: %s", arguments, actual,
                 status, said);
    snprintf(list, sizeof list, "%s", words);
    for (char *word = strtok(list, "|"); word; word = strtok(NULL, "|"))
        if (!strstr(said, word))
            fail_msg("%s: no '%s' in: %s", arguments, word, said);
}

/* Start a demo, send it the signal as soon as it renders, and return its exit status. */
static inline int run_and_signal(const char *name, const char *arguments)
{
    char command[1000];
    snprintf(
        command, sizeof command,
        "\"$DEMOS\"/%s >log.txt 2>&1 & demo=$!; "
        "for i in $(seq 200); do grep -q bounces log.txt && break; sleep 0.05; done; "
        "sleep 0.1; kill -%s $demo; wait $demo; status=$?; cat log.txt; exit $status",
        arguments, name);
    return run(command);
}

static inline bool exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0;
}

static inline size_t read_file(const char *path, unsigned char *bytes, size_t size)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot open %s", path);
    const size_t n = fread(bytes, 1, size, file);
    fclose(file);
    return n;
}

static inline void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static inline int remove_one(const char *path, const struct stat *info, int kind,
                             struct FTW *place)
{
    (void)info;
    (void)kind;
    (void)place;
    return remove(path);
}

static inline int set_up(void **state)
{
    (void)state;
    const char *given = getenv("BUILD");
    char top[4096];
    if (!getcwd(top, sizeof top) || setenv("TOP", top, 1) != 0)
        return -1;
    if (!realpath(given ? given : "build", demos) || setenv("DEMOS", demos, 1) != 0 ||
        setenv("LC_ALL", "C", 1) != 0 || unsetenv("DISPLAY") != 0 ||
        unsetenv("WAYLAND_DISPLAY") != 0 || !mkdtemp(folder))
        return -1;
    return chdir(folder);
}

static inline int tear_down(void **state)
{
    (void)state;
    return chdir("/") || nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

#endif

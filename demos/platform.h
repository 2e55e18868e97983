/* What differs from system to system: names of files, the terminal, Ctrl-C, another process. The
 * rest of the demos is plain C. All names are in UTF-8. */
#ifndef PLATFORM_H
#define PLATFORM_H

#include <stdbool.h>
#include <stdio.h>

/* Returns the words of the command line; from now on the terminal takes UTF-8. */
char **platform_begin(int *argc, char **argv);
/* Puts the terminal back as it was. A terminal that closes together with this program, as after a
 * double click, first waits if it has an error to show. */
void platform_end(bool good);
/* Ctrl-C, or a wish to end the program, calls stop; the second one ends it. A closed pipe is an
 * error like any other, not the end. */
void platform_on_interrupt(void (*stop)(int signal));

/* Give a variable of the environment a value, unless it has one. */
void platform_set_default(const char *name, const char *value);
/* Leave the core to others, for about so many milliseconds. */
void platform_sleep(int milliseconds);

/* ---- files: those that fail set errno ------------------------------------------------ */

FILE *platform_open(const char *path, const char *mode); /* as fopen */
void platform_remove(const char *path);

typedef enum platform_kind { NO_FILE, A_FILE, A_FOLDER, A_DEVICE } platform_kind;

typedef struct platform_info {
    long long size;    /* in bytes */
    long long written; /* when, in seconds since some moment */
} platform_info;

/* What has this name? More about a file goes to *info, unless that is NULL. */
platform_kind platform_look(const char *path, platform_info *info);
/* How long is the folder in the path, with the slash at its end? */
int platform_folder(const char *path);
/* The file behind a symbolic link; free it. NULL: there is no file yet. */
char *platform_behind(const char *path);
/* Give a file another name, in place of the file that had it. NULL, or why it cannot be. */
const char *platform_replace(const char *from, const char *to);

/* ---- terminal and display ------------------------------------------------------------ */

/* Is stderr a terminal that can write a line anew? */
bool platform_has_terminal(void);
/* How many colours it has: 0 (none, or no terminal), 256, or 2^24. */
int platform_colours(void);
/* Leaves them as they are if it does not know. */
void platform_terminal_size(int *columns, int *rows);
/* False: there is surely no display, and to look for one would only print complaints. */
bool platform_may_have_display(void);

/* ---- another process ----------------------------------------------------------------- */

typedef enum platform_result { WELL, TOO_LONG, BADLY } platform_result;

/* Call work in another process, with so much memory and time. How did it end? Windows has no
 * such processes: there it is called in this one, without limits. */
platform_result platform_apart(bool (*work)(const char *path, FILE *to), const char *path,
                               FILE *to, int gigabytes, int seconds);

#endif

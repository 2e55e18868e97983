/* The systems: see platform.h. Windows comes first, then all the others. */
#ifdef _WIN32

#include "platform.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <windows.h>

#include <shellapi.h>

enum { LONGEST = 260 }; /* path, for Windows, with the 0 at its end */

static struct {
    void *error; /* stderr, if it is a terminal that knows escape codes, otherwise NULL */
    DWORD mode;  /* of it, before */
    UINT page;   /* code page of the terminal, before */
} terminal;

/* Windows has its names in UTF-16. Too long: "". */
static const wchar_t *wide(const char *text, wchar_t result[LONGEST])
{
    if (MultiByteToWideChar(CP_UTF8, 0, text, -1, result, LONGEST) == 0)
        result[0] = L'\0';
    return result;
}

/* Not argv: its words are in a code page that may lack their letters. */
char **platform_begin(int *argc, char **argv)
{
    const wchar_t *line = GetCommandLineW();
    int count = 0, used = 0;
    wchar_t **words = CommandLineToArgvW(line, &count);
    const int size = 3 * ((int)wcslen(line) + 1);
    char **result = calloc((size_t)count + 1, sizeof *result);
    char *text = malloc((size_t)size);
    if (words && result && text) {
        for (int i = 0; i < count; i++) {
            result[i] = text + used;
            used += WideCharToMultiByte(CP_UTF8, 0, words[i], -1, text + used,
                                        size - used, NULL, NULL);
        }
        *argc = count;
        argv = result;
    }
    LocalFree(words);
    terminal.page = GetConsoleOutputCP();
    SetConsoleOutputCP(CP_UTF8);
    terminal.error = GetStdHandle(STD_ERROR_HANDLE);
    if (!GetConsoleMode(terminal.error, &terminal.mode) ||
        !SetConsoleMode(terminal.error,
                        terminal.mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING))
        terminal.error = NULL;
    return argv;
}

void platform_end(bool good)
{
    DWORD all, mode;
    if (!good &&
        GetConsoleProcessList(&all, 1) == 1 && /* nobody else is in the terminal */
        GetConsoleMode(GetStdHandle(STD_INPUT_HANDLE), &mode)) {
        fprintf(stderr, "Enter closes this window.\n");
        getchar();
    }
    if (terminal.error)
        SetConsoleMode(terminal.error, terminal.mode);
    SetConsoleOutputCP(terminal.page);
}

void platform_on_interrupt(void (*stop)(int signal))
{
    signal(SIGINT, stop); /* once: then it is as it was */
}

void platform_set_default(const char *name, const char *value)
{
    if (!getenv(name))
        _putenv_s(name, value);
}

void platform_sleep(int milliseconds)
{
    Sleep((DWORD)milliseconds);
}

/* _wfopen of older Windows does not know the x of "wbx". */
FILE *platform_open(const char *path, const char *mode)
{
    wchar_t name[LONGEST];
    if (!strchr(mode, 'x'))
        return _wfopen(wide(path, name), *mode == 'r' ? L"rb" : L"wb");
    const int file = _wopen(wide(path, name), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY,
                            _S_IREAD | _S_IWRITE);
    return file >= 0 ? _fdopen(file, "wb") : NULL;
}

void platform_remove(const char *path)
{
    wchar_t name[LONGEST];
    _wremove(wide(path, name));
}

platform_kind platform_look(const char *path, platform_info *info)
{
    wchar_t name[LONGEST];
    struct _stat64 file;
    if (!*wide(path, name) || strpbrk(path, "?*<>|\"")) {
        errno = *name ? EINVAL : ENAMETOOLONG;
        return NO_FILE;
    }
    if (_wstat64(name, &file) != 0)
        return NO_FILE;
    if (info)
        *info = (platform_info){file.st_size, file.st_mtime};
    return file.st_mode & _S_IFDIR   ? A_FOLDER
           : file.st_mode & _S_IFREG ? A_FILE
                                     : A_DEVICE;
}

int platform_folder(const char *path)
{
    int length = (int)strlen(path);
    while (length > 0 && !strchr("/\\:", path[length - 1]))
        length--;
    return length;
}

char *platform_behind(const char *path)
{
    (void)path; /* links are rare there: they are replaced */
    return NULL;
}

const char *platform_replace(const char *from, const char *to)
{
    wchar_t name[LONGEST], other[LONGEST];
    if (MoveFileExW(wide(from, name), wide(to, other), MOVEFILE_REPLACE_EXISTING))
        return NULL;
    const DWORD attributes = GetFileAttributesW(other);
    return attributes == INVALID_FILE_ATTRIBUTES  ? "Windows does not allow it"
           : attributes & FILE_ATTRIBUTE_READONLY ? "the file is read-only"
                                                  : "another program has the file open";
}

bool platform_has_terminal(void)
{
    return terminal.error != NULL;
}

int platform_colours(void)
{
    return terminal.error ? 1 << 24 : 0;
}

void platform_terminal_size(int *columns, int *rows)
{
    CONSOLE_SCREEN_BUFFER_INFO info;
    if (!GetConsoleScreenBufferInfo(terminal.error, &info))
        return;
    *columns = info.srWindow.Right - info.srWindow.Left + 1;
    *rows = info.srWindow.Bottom - info.srWindow.Top + 1;
}

bool platform_may_have_display(void)
{
    return true;
}

platform_result platform_apart(bool (*work)(const char *path, FILE *to), const char *path,
                               FILE *to, int gigabytes, int seconds)
{
    (void)gigabytes, (void)seconds;
    return work(path, to) ? WELL : BADLY;
}

#else

#define _DEFAULT_SOURCE   /* winsize */
#define _DARWIN_C_SOURCE  /* the same on macOS */
#define _XOPEN_SOURCE 700 /* stat, realpath, isatty, sigaction, fork */
#include "platform.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

char **platform_begin(int *argc, char **argv)
{
    (void)argc;
    return argv;
}

void platform_end(bool good)
{
    (void)good;
}

void platform_on_interrupt(void (*stop)(int signal))
{
    struct sigaction action = {.sa_handler = stop};
    action.sa_flags = (int)SA_RESETHAND;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    signal(SIGPIPE, SIG_IGN);
}

void platform_set_default(const char *name, const char *value)
{
    setenv(name, value, 0);
}

void platform_sleep(int milliseconds)
{
    const struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
    nanosleep(&time, NULL);
}

FILE *platform_open(const char *path, const char *mode)
{
    return fopen(path, mode);
}

void platform_remove(const char *path)
{
    remove(path);
}

platform_kind platform_look(const char *path, platform_info *info)
{
    struct stat file;
    if (stat(path, &file) != 0)
        return NO_FILE;
    if (info)
        *info = (platform_info){file.st_size, file.st_mtime};
    return S_ISDIR(file.st_mode) ? A_FOLDER : S_ISREG(file.st_mode) ? A_FILE : A_DEVICE;
}

int platform_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (int)(slash - path) + 1 : 0;
}

char *platform_behind(const char *path)
{
    return realpath(path, NULL);
}

const char *platform_replace(const char *from, const char *to)
{
    return rename(from, to) == 0 ? NULL : strerror(errno);
}

bool platform_has_terminal(void)
{
    const char *term = getenv("TERM");
    return isatty(fileno(stderr)) && (!term || strcmp(term, "dumb") != 0);
}

int platform_colours(void)
{
    const char *term = getenv("TERM"), *colour = getenv("COLORTERM");
    if (!platform_has_terminal() || !term)
        return 0;
    if ((colour && (strcmp(colour, "truecolor") == 0 || strcmp(colour, "24bit") == 0)) ||
        strstr(term, "-direct"))
        return 1 << 24;
    return strstr(term, "256color") ? 256 : 0;
}

void platform_terminal_size(int *columns, int *rows)
{
    struct winsize size;
    if (ioctl(fileno(stderr), TIOCGWINSZ, &size) != 0)
        return;
    *columns = size.ws_col;
    *rows = size.ws_row;
}

bool platform_may_have_display(void)
{
#ifdef __linux__
    return getenv("DISPLAY") || getenv("WAYLAND_DISPLAY");
#else
    return true;
#endif
}

/* (The sanitizers need any amount of memory for themselves.) */
static void set_limits(int gigabytes, int seconds)
{
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const struct rlimit memory = {(rlim_t)gigabytes << 30, (rlim_t)gigabytes << 30};
    setrlimit(RLIMIT_AS, &memory);
#else
    (void)gigabytes;
#endif
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    signal(SIGALRM, SIG_DFL);
    alarm((unsigned)seconds);
}

platform_result platform_apart(bool (*work)(const char *path, FILE *to), const char *path,
                               FILE *to, int gigabytes, int seconds)
{
    int status = -1;
    const pid_t child = fork();
    if (child == 0) {
        set_limits(gigabytes, seconds);
        if (!freopen("/dev/null", "w", stderr)) /* libraries complain as they like */
            _exit(1);
        _exit(work(path, to) ? 0 : 1);
    }
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return TOO_LONG;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? WELL : BADLY;
}

#endif

#if defined(__x86_64__) && defined(__GNUC__)
/* Was this compiled for more than this machine has (-march=native, and then copied)? Ask
 * before main, in plain x86-64, since main itself may use what is missing. */
__attribute__((constructor, target("arch=x86-64"))) static void check_machine(void)
{
    const char *lacks = NULL;
    __builtin_cpu_init();
#ifdef __AVX2__
    lacks = __builtin_cpu_supports("avx2") ? lacks : "AVX2";
#endif
#ifdef __AVX512F__
    lacks = __builtin_cpu_supports("avx512f") ? lacks : "AVX-512";
#endif
    if (lacks) {
        fprintf(stderr,
                "compiled for a machine with %s, which this one lacks: make -B "
                "MACHINE= makes a program for any\n",
                lacks);
        exit(1);
    }
}
#endif

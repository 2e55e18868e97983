/* Running other people's programs, so that they can do nothing but compute: on Linux the kernel
 * ends a program that asks for anything but memory and the channels it was given (seccomp);
 * everywhere time, memory and the size of files are limited. */
#ifndef SANDBOX_H
#define SANDBOX_H

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef __linux__
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif
#ifdef __APPLE__
#define st_mtim st_mtimespec
#endif

typedef struct task {
    char *const *argv;
    bool confined; /* may only compute; else: a compiler */
    bool talks;    /* what it prints is shown; else it goes to the file log, if any */
    const char *log;
    double seconds;
    const char *in; /* what it reads, if anything */
    size_t in_size;
    char *out; /* what it answers, on channel 3 */
    size_t out_size;
} task;

static inline double clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline void limit(int what, unsigned long long most)
{
    const struct rlimit r = {(rlim_t)most, (rlim_t)most};
    setrlimit(what, &r);
}

/* From now on, and after exec: only these calls, or the end. */
static inline bool confine(void)
{
#ifdef __linux__
#if defined(__x86_64__)
#define SANDBOX_ARCH AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define SANDBOX_ARCH AUDIT_ARCH_AARCH64
#endif
#ifdef SANDBOX_ARCH
#define ALLOW(call)                                                                      \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##call, 0, 1),                               \
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)
#define REFUSE(call)                                                                     \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##call, 0, 1),                               \
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM)
    struct sock_filter rules[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SANDBOX_ARCH, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        ALLOW(read),
        ALLOW(write),
        ALLOW(writev),
        ALLOW(exit),
        ALLOW(exit_group),
        ALLOW(brk),
        ALLOW(mmap),
        ALLOW(munmap),
        ALLOW(mremap),
        ALLOW(mprotect),
        ALLOW(madvise),
        ALLOW(rt_sigaction),
        ALLOW(rt_sigprocmask),
        ALLOW(rt_sigreturn),
        ALLOW(set_tid_address),
        ALLOW(set_robust_list),
        ALLOW(futex),
        ALLOW(getrandom),
        ALLOW(clock_gettime),
        ALLOW(fstat),
        ALLOW(newfstatat),
        ALLOW(execve),
#ifdef SYS_arch_prctl
        ALLOW(arch_prctl),
#endif
#ifdef SYS_rseq
        ALLOW(rseq),
#endif
#ifdef SYS_readlink
        REFUSE(readlink),
#endif
        REFUSE(readlinkat),
        REFUSE(prlimit64),
        REFUSE(ioctl),
        REFUSE(lseek),
        ALLOW(getpid),
        ALLOW(gettid),
        REFUSE(tgkill), /* abort() */
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
    };
    const struct sock_fprog program = {sizeof rules / sizeof rules[0], rules};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
#endif
#endif
    return false;
}

static inline void become(const task *t, int in, int out)
{
    const int null = open("/dev/null", O_RDWR);
    const int log = t->log ? open(t->log, O_WRONLY | O_CREAT | O_TRUNC, 0600) : null;
    setsid();
    dup2(out, 63); /* out of the way */
    dup2(t->in ? in : null, 0);
    if (!t->talks) {
        dup2(log, 1);
        dup2(log, 2);
    }
    dup2(63, 3);
    for (int i = 4; i < 1024; i++)
        close(i);
    limit(RLIMIT_CPU, (unsigned long long)t->seconds + 1);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_AS, t->confined ? 1ull << 30 : 2ull << 30);
    limit(RLIMIT_FSIZE, t->confined && !t->talks ? 0 : 16ull << 20);
    if (t->confined)
        confine();
    execvp(t->argv[0], t->argv);
    _exit(127);
}

/* Feed it, read its answer, until it has answered, ends or the time is over. */
static inline size_t converse(const task *t, int to, int from, double deadline)
{
    size_t written = 0, got = 0;
    fcntl(to, F_SETFL, O_NONBLOCK);
    fcntl(from, F_SETFL, O_NONBLOCK);
    while (clock_seconds() < deadline) {
        struct pollfd p[2] = {{from, POLLIN, 0},
                              {written < t->in_size ? to : -1, POLLOUT, 0}};
        char more;
        poll(p, 2, 50);
        if (p[1].revents != 0) {
            const ssize_t n = write(to, t->in + written, t->in_size - written);
            written = n > 0                      ? written + (size_t)n
                      : n < 0 && errno == EAGAIN ? written
                                                 : t->in_size;
        }
        if (p[0].revents != 0) {
            const bool full = got == t->out_size;
            const ssize_t n =
                full ? read(from, &more, 1) : read(from, t->out + got, t->out_size - got);
            if (n == 0 || (n < 0 && errno != EAGAIN) || (n > 0 && full))
                break; /* it has closed the channel, or says more than it was asked */
            got += n > 0 && !full ? (size_t)n : 0;
        }
    }
    return got;
}

/* What runs now, to be ended with us: it has a session of its own, and no terminal ends it. */
static volatile pid_t running;

static inline void end_both(int signal_number)
{
    if (running > 0)
        kill(-running, SIGKILL);
    _exit(128 + signal_number);
}

/* True if the program ended well and said as much as it should; if not, why says why. */
static inline bool run_task(const task *t, char *why, size_t size)
{
    int in[2], out[2], status = 0;
    why[0] = '\0';
    if (pipe(in) != 0 || pipe(out) != 0)
        return snprintf(why, size, "cannot make a pipe: %s", strerror(errno)), false;
    signal(SIGPIPE, SIG_IGN);
    signal(SIGINT, end_both);
    signal(SIGTERM, end_both);
    const pid_t child = fork();
    if (child == 0)
        become(t, in[0], out[1]);
    running = child;
    close(in[0]);
    close(out[1]);
    const double deadline = clock_seconds() + t->seconds;
    const size_t got = child > 0 ? converse(t, in[1], out[0], deadline) : 0;
    close(in[1]);
    close(out[0]);
    if (child < 0)
        return snprintf(why, size, "cannot start it: %s", strerror(errno)), false;
    pid_t ended = 0;
    while ((ended = waitpid(child, &status, WNOHANG)) == 0 && clock_seconds() < deadline)
        nanosleep(&(struct timespec){0, 2000000}, NULL);
    if (ended == 0) {
        kill(-child, SIGKILL);
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        return snprintf(why, size, "no end within %g seconds", t->seconds), false;
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS)
        return snprintf(why, size,
                        "ended by the system: it wanted more than to compute (files, "
                        "other programs, the network ...)"),
               false;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return snprintf(why, size, "no end within %g seconds", t->seconds), false;
    if (WIFSIGNALED(status))
        return snprintf(why, size, "it crashed: %s", strsignal(WTERMSIG(status))), false;
    if (WEXITSTATUS(status) != 0 || (t->out_size > 0 && got != t->out_size))
        return snprintf(why, size, "it ended by itself, with status %d",
                        WEXITSTATUS(status)),
               false;
    return true;
}

#endif

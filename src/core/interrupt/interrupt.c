/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/interrupt/interrupt.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

/* Files are written one after another; a picture's numbers may be a second. */
enum { MOST_FILES = 4, LONGEST_PATH = 8192, INTERRUPTED = 130 };

static char half_written[MOST_FILES][LONGEST_PATH];
static volatile sig_atomic_t is_half_written[MOST_FILES];
static volatile sig_atomic_t completed;
static volatile sig_atomic_t speaks, on_terminal;
static int handles;
static void (*tick)(void);

static void say(const char *text)
{
    const ssize_t written = write(STDERR_FILENO, text, strlen(text));
    (void)written; /* nobody is left to be told */
}

static void end(int signal_number)
{
    (void)signal_number;
    for (int f = 0; f < MOST_FILES; f++)
        if (is_half_written[f])
            unlink(half_written[f]);
    if (speaks) {
        if (on_terminal)
            say("\r\033[K");
        say(completed > 0 ? "orthostat: interrupted; the files that were complete stay, nothing else was written\n"
                          : "orthostat: interrupted, nothing written\n");
    } else {
        sleep(1); /* as soon as one rank ends mpirun kills the others: first the one that speaks */
    }
    _exit(INTERRUPTED);
}

static void handle(int number, void (*handler)(int), int flags)
{
    struct sigaction action = {.sa_flags = flags};
    action.sa_handler = handler;
    sigfillset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

void ost_end_when_interrupted(int says)
{
    speaks = says;
    on_terminal = isatty(STDERR_FILENO) || getenv("ORTHOSTAT_ON_TERMINAL"); /* which mpirun hides */
    handles = 1;
    handle(SIGINT, end, 0);
    handle(SIGTERM, end, 0);
}

void ost_metis_failed(void)
{
    if (handles)
        raise(SIGTERM);
}

void ost_work_is_over(void)
{
    handles = 0;
    handle(SIGINT, SIG_DFL, 0);
    handle(SIGTERM, SIG_DFL, 0);
}

void ost_half_written(const char *path)
{
    for (int f = 0; f < MOST_FILES; f++)
        if (!is_half_written[f] && strlen(path) < LONGEST_PATH) {
            strcpy(half_written[f], path);
            is_half_written[f] = 1;
            return;
        }
}

void ost_half_written_forget(const char *path, int is_complete)
{
    for (int f = 0; f < MOST_FILES; f++)
        if (is_half_written[f] && strcmp(half_written[f], path) == 0)
            is_half_written[f] = 0;
    if (is_complete)
        completed = 1;
}

static void on_tick(int number)
{
    const int kept = errno;
    (void)number;
    tick();
    errno = kept;
}

void ost_tick_every_second(void (*call)(void))
{
    const struct itimerval second = {{1, 0}, {1, 0}};
    tick = call;
    handle(SIGALRM, on_tick, SA_RESTART);
    setitimer(ITIMER_REAL, &second, NULL);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/dry_run.h"

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* Takes the place of the library's: a fork for each file, dear under the address sanitizer, would leave a few dozen
 * files a second. Here a process reads one file after the other, until one of them ends it or it has had enough of
 * them for what HDF5 leaves behind. */

/* What is asked of the process, which has all that the pointers name since before the fork. */
typedef struct Request {
    OstReading *read_file;
    const char *name;
} Request;

enum { FILES_PER_PROCESS = 500, NO_PROCESS = 0 };

static pid_t process;
static int wire;
static int files;

/* libFuzzer would keep what ends the process as if it had ended the reader. Not there without a sanitizer. */
__attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)(void));

static void give_up(const char *what)
{
    perror(what);
    exit(1);
}

static void dry_run_on_request(OstContext *ctx, const char *path)
{
    Request request;
    const int silence = open("/dev/null", O_WRONLY);
    if (silence >= 0)
        dup2(silence, STDERR_FILENO);
    if (__sanitizer_set_death_callback)
        __sanitizer_set_death_callback(NULL);
    while (read(wire, &request, sizeof request) == sizeof request) {
        ost_hdf5_dry_run_here(ctx, path, request.read_file, request.name);
        if (write(wire, "", 1) != 1)
            break;
    }
    _exit(0);
}

static void start(OstContext *ctx, const char *path)
{
    int ends[2];
    H5set_free_list_limits(-1, -1, 4 << 20, 256 << 10, 16 << 20,
                           1 << 20); /* keep the largest nodes; the rest as it is */
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
        give_up("dry run: socketpair");
    process = fork();
    if (process < 0)
        give_up("dry run: fork");
    wire = ends[process == 0];
    close(ends[process != 0]);
    if (process == 0)
        dry_run_on_request(ctx, path);
    files = 0;
}

/* How the process ended, as waitpid tells it. */
static int finish(void)
{
    int how = 0;
    close(wire);
    while (waitpid(process, &how, 0) < 0)
        if (errno != EINTR)
            give_up("dry run: waitpid");
    process = NO_PROCESS;
    return how;
}

OstStatus ost_hdf5_dry_run(OstContext *ctx, const char *path, OstReading *read_file, const char *name)
{
    const Request request = {read_file, name};
    char word = 0;
    if (process == NO_PROCESS)
        start(ctx, path);
    if (write(wire, &request, sizeof request) != sizeof request)
        give_up("dry run: write");
    if (read(wire, &word, 1) != 1)
        return ost_hdf5_raise_lost(ctx, path, finish());
    if (++files == FILES_PER_PROCESS)
        finish();
    return OST_SUCCESS;
}

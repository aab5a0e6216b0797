/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/dry_run.h"

#include "core/error.h"

#include <hdf5.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { OUT_OF_MEMORY = 1, MEMORY_FACTOR = 10, LIBRARY_BYTES = 64 << 20, BYTES_PER_SECOND = 10 << 20 };

/* Limits memory to ten times the file beyond what is mapped already, plus 64 MiB for HDF5; and the processor time,
 * which grows with the file. */
static int set_limits(const char *path)
{
    struct stat facts;
    struct rlimit space;
    unsigned long pages = 0;
    FILE *memory = fopen("/proc/self/statm", "r");
    const int known = memory && fscanf(memory, "%lu", &pages) == 1 && stat(path, &facts) == 0;
    if (memory)
        fclose(memory);
    if (!known || getrlimit(RLIMIT_AS, &space) != 0)
        return -1;
    const rlim_t mapped = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
    const rlim_t most = mapped + LIBRARY_BYTES + MEMORY_FACTOR * (rlim_t)facts.st_size;
    const struct itimerval second = {.it_value = {.tv_sec = 1 + facts.st_size / BYTES_PER_SECOND}};
    space.rlim_cur = most < space.rlim_max ? most : space.rlim_max;
    return setrlimit(RLIMIT_AS, &space) != 0 || setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0}) != 0 ||
                   setitimer(ITIMER_PROF, &second, NULL) != 0
               ? -1
               : 0;
}

static herr_t find_no_memory(unsigned n, const H5E_error2_t *error, void *found)
{
    (void)n;
    if (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC)
        *(int *)found = 1;
    return 0;
}

/* HDF5 calls this at each of its errors. Lack of memory ends the process: with the limit lifted the real reading would
 * go on. All other errors will come again in the real reading. */
static herr_t exit_without_memory(hid_t stack, void *ctx)
{
    int found = 0;
    (void)ctx;
    H5Ewalk2(stack, H5E_WALK_UPWARD, find_no_memory, &found);
    if (found)
        _exit(OUT_OF_MEMORY);
    return 0;
}

void ost_hdf5_dry_run_here(OstContext *ctx, const char *path, OstReading *read, const char *name)
{
    static const int fatal[] = {SIGPROF, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++)
        signal(fatal[i], SIG_DFL); /* MPI's handlers would print */
    if (set_limits(path) != 0)
        return;
    H5Eset_auto2(H5E_DEFAULT, exit_without_memory, ctx);
    if (read(ctx, path, name) == OST_OUT_OF_MEMORY)
        _exit(OUT_OF_MEMORY);
}

OstStatus ost_hdf5_raise_lost(OstContext *ctx, const char *path, int how)
{
    return OST_RAISE(ctx, OST_FILE_FAILED, "%s: the file is damaged: reading it %s; write it again", path,
                     WIFEXITED(how)             ? "asks for too much memory"
                     : WTERMSIG(how) == SIGPROF ? "does not come to an end"
                                                : "crashes");
}

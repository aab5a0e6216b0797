/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"

#include <fcntl.h>
#include <limits.h>
#include <mpi.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/* Hands each input to the reader as a file, or as what a target makes of it, in a folder of this process that lives in
 * memory. */

static OstContext *ctx;
static char folder[64];
static char path[PATH_MAX];
static pid_t owner;

static void clean_up(void)
{
    if (getpid() != owner)
        return;
    unlink(path);
    rmdir(folder);
    ost_context_destroy(&ctx);
    MPI_Finalize();
}

static void give_up(const char *what)
{
    perror(what);
    exit(1);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    MPI_Init(argc, argv);
    signal(SIGABRT, SIG_DFL); /* Open MPI's handlers would hide a crash from libFuzzer */
    signal(SIGFPE, SIG_DFL);
    if (ost_context_create(MPI_COMM_SELF, &ctx) != OST_SUCCESS)
        give_up("fuzz: no context");
    ost_log_set_level(ctx, OST_LOG_QUIET);
    snprintf(folder, sizeof folder, "%s/orthostat-fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (!mkdtemp(folder))
        give_up(folder);
    snprintf(path, sizeof path, "%s/%s", folder, fuzz_target.file);
    owner = getpid();
    atexit(clean_up);
    fuzz_target.read(ctx, path); /* no such file: loads what the libraries load once */
    return 0;
}

static size_t write_file(const uint8_t *data, size_t size)
{
    if (fuzz_target.write)
        return fuzz_target.write(data, size, path);
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || write(file, data, size) != (ssize_t)size || close(file) != 0)
        give_up(path);
    return size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const size_t file_size = write_file(data, size);
    fuzz_limits_start(ctx);
    fuzz_target.read(ctx, path);
    fuzz_limits_end(ctx, file_size);
    return 0;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/start.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

enum { LONGEST_PATH = 4096, MOST_LAUNCHED = 4096 };

/* Could another process's memory be read? Containers often forbid it, and Open MPI then complains at every start. */
static int may_read_memory(void)
{
    char from = 1, to = 0;
    const struct iovec local = {&to, 1}, remote = {&from, 1};
    return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) == 1;
}

void ost_cli_settle_environment(char **argv)
{
    const int late = getenv("OPENBLAS_NUM_THREADS") == NULL;
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    setenv("OMP_NUM_THREADS", "1", 0);
    setenv("MKL_NUM_THREADS", "1", 0);
    setenv("HWLOC_COMPONENTS", "-gl", 0);
    if (!may_read_memory())
        setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
    if (late)
        execv("/proc/self/exe", argv); /* returns only if there is no /proc: then the BLAS keeps its threads */
}

int ost_cli_is_launched(void)
{
    static const char *const signs[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "MPI_LOCALNRANKS",
                                        "SLURM_STEP_ID"};
    for (size_t s = 0; s < sizeof signs / sizeof signs[0]; s++)
        if (getenv(signs[s]))
            return 1;
    return 0;
}

static int count_cores(void)
{
    cpu_set_t mine;
    return sched_getaffinity(0, sizeof mine, &mine) == 0 ? CPU_COUNT(&mine) : 1;
}

/* The largest number of --ranks; the cores, if there is no such option; 0 for what is not to be started. */
static int ranks_asked_for(int argc, char **argv)
{
    const char *list = NULL;
    long most = 0;
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0 || strcmp(argv[i], "-?") == 0)
            return 0;
        if (strncmp(argv[i], "--ranks=", 8) == 0)
            list = argv[i] + 8;
        else if (strcmp(argv[i], "--ranks") == 0 && i + 1 < argc)
            list = argv[i + 1];
    }
    if (!list)
        return count_cores();
    for (char *end = NULL; *list; list = *end ? end + 1 : end) {
        const long ranks = strtol(list, &end, 10);
        if (end == list)
            return 0; /* the command says what is wrong with it */
        most = ranks > most ? ranks : most;
    }
    return most <= MOST_LAUNCHED ? (int)most : 0;
}

void ost_cli_launch_scale(int argc, char **argv)
{
    char program[LONGEST_PATH] = "", count[16];
    int command = 1;
    while (command < argc && argv[command][0] == '-') /* -q and -v may come first */
        command++;
    if (command >= argc || strcmp(argv[command], "scale") != 0 || ost_cli_is_launched())
        return;
    const int ranks = ranks_asked_for(argc, argv);
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (ranks < 2 || length <= 0)
        return;
    char **words = calloc((size_t)argc + 5, sizeof *words);
    if (!words)
        return;
    snprintf(count, sizeof count, "%d", ranks);
    char *const start[] = {"mpirun", "--quiet", "-n", count, program};
    for (size_t i = 0; i < 5; i++)
        words[i] = start[i];
    for (int i = 1; i < argc; i++)
        words[4 + i] = argv[i];
    /* More ranks than cores are meant, and so is root, who has started this program. */
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
    if (isatty(STDERR_FILENO))
        setenv("ORTHOSTAT_ON_TERMINAL", "1", 0);
    execvp("mpirun", words);
    perror("orthostat: mpirun could not be started; there is one rank");
    free(words);
}

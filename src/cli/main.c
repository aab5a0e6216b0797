/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/yaml/message.h"
#include "cli/command.h"
#include "core/address_space.h"
#include "core/interrupt/interrupt.h"
#include "core/progress.h"

#include <dlfcn.h>
#include <errno.h>
#include <mpi.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/uio.h>
#include <unistd.h>

static const struct {
    const char *name, *summary;
    int (*run)(OstContext *ctx, int argc, char **argv);
} commands[] = {
    {"solve", "solve a case and write its fields for ParaView", ost_cli_solve},
    {"check", "read a case and its mesh, and report what is wrong with them", ost_cli_check},
    {"explain", "list the effects that a case calls for, and what it will cost", ost_cli_explain},
    {"effects", "measure what each effect changes and costs: solve with each one left out", ost_cli_effects},
    {"cost", "measure what accuracy costs: errors, seconds and memory by order, refinement and tolerance",
     ost_cli_cost},
    {"scale", "measure how a case scales: seconds, iterations and messages by size and number of ranks", ost_cli_scale},
    {"sweep", "solve for several values of a number, and list the watched quantities", ost_cli_sweep},
    {"verify", "compare answers with closed-form solutions", ost_cli_verify},
    {"mesh", "inspect, convert, refine and repair a mesh", ost_cli_mesh},
    {"material", "print a material's stiffness, its eigenvalues and its stable range", ost_cli_material},
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_help(FILE *stream)
{
    fputs("Usage: orthostat COMMAND [OPTION...] ...\n"
          "Static poses of orthotropic solids on tetrahedral meshes.\n\n",
          stream);
    for (int i = 0; i < COMMAND_COUNT; i++)
        fprintf(stream, "  %-10s %s\n", commands[i].name, commands[i].summary);
    fputs("\nEvery command takes --help, -q (print nothing but errors, and the JSON or CSV that is asked for) and -v\n"
          "(say more); -q and -v may come first.\n"
          "Exit status: 0 done, 1 not converged or a check failed, 2 wrong usage or input, 130 interrupted.\n",
          stream);
}

static int is_one_of(const char *word, const char *a, const char *b)
{
    return strcmp(word, a) == 0 || strcmp(word, b) == 0;
}

/* With the nearest command, or with all. */
static void refuse_command(const char *name)
{
    const char *names[COMMAND_COUNT];
    for (int i = 0; i < COMMAND_COUNT; i++)
        names[i] = commands[i].name;
    const char *nearest = ost_nearest_word(name, names, COMMAND_COUNT);
    fprintf(stderr, "orthostat: error: there is no command '%s'", name);
    if (nearest) {
        fprintf(stderr, "; did you mean '%s'?\n", nearest);
        return;
    }
    fputs("\n\n", stderr);
    print_help(stderr);
}

static int run_command(OstContext *ctx, int argc, char **argv)
{
    const char *name = argv[1];
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, name) != 0)
            continue;
        char title[64];
        snprintf(title, sizeof title, "orthostat %s", name);
        argv[1] = title;
        return commands[i].run(ctx, argc - 1, argv + 1);
    }
    if (ost_rank(ctx) == 0)
        refuse_command(name);
    return ost_status_exit_code(OST_INVALID_USAGE);
}

/* Removes -q and -v before the command; the last one counts. */
static OstLogLevel take_level(int *argc, char ***argv)
{
    OstLogLevel level = OST_LOG_NORMAL;
    for (; *argc > 1; (*argv)++, (*argc)--) {
        char **first = *argv;
        if (is_one_of(first[1], "-q", "--quiet"))
            level = OST_LOG_QUIET;
        else if (is_one_of(first[1], "-v", "--verbose"))
            level = OST_LOG_VERBOSE;
        else
            break;
        first[1] = first[0];
    }
    return level;
}

/* Is this rank 0, or no MPI run? Open MPI sets a process's rank in its environment, before MPI starts. */
static int prints_before_mpi(void)
{
    const char *rank = getenv("OMPI_COMM_WORLD_RANK");
    return !rank || strcmp(rank, "0") == 0;
}

/* Prints version or help without starting MPI, and returns the exit code; -1 if there is more to do. Ranks that print
 * nothing return 0: mpirun would kill the one that prints as soon as another fails. */
static int answer_at_once(int argc, char **argv)
{
    const int asks_version = argc == 2 && is_one_of(argv[1], "--version", "-V");
    const int asks_help = argc == 2 && is_one_of(argv[1], "--help", "-h");
    if (argc > 1 && !asks_version && !asks_help)
        return -1;
    if (!prints_before_mpi())
        return 0;
    if (asks_version)
        puts("orthostat " ORTHOSTAT_VERSION);
    else
        print_help(asks_help ? stdout : stderr);
    return argc > 1 ? 0 : ost_status_exit_code(OST_INVALID_USAGE);
}

/* A full disk may only show when the last of the output is flushed. Under mpirun, standard output is a pipe. */
static int end_with(int exit_code)
{
    errno = 0;
    const int lost = fflush(stdout) != 0 || ferror(stdout);
    if (lost && !errno) /* an earlier line was: the reason is asked for again */
        fputc('\n', stdout);
    if (lost)
        fprintf(stderr, "orthostat: error: standard output could not be written%s%s\n", errno ? ": " : "",
                errno ? strerror(errno) : "");
    return lost && exit_code == 0 ? ost_status_exit_code(OST_FILE_FAILED) : exit_code;
}

/* MPI takes some 200 MiB of address space when it starts, and fails in ways of its own, or crashes, where a limit
 * leaves less; OpenBLAS, which takes 128 MiB, waits for ever. Every rank says so: the limits of machines may differ. */
static int has_room_to_start(void)
{
    enum { MIB_TO_START = 512 };
    struct rlimit limit = {.rlim_cur = RLIM_INFINITY};
    if (ost_address_space_has(MIB_TO_START))
        return 1;
    getrlimit(RLIMIT_AS, &limit);
    fprintf(stderr, "orthostat: error: MPI and OpenBLAS need %d MiB of address space to start, and there is less",
            MIB_TO_START);
    if (limit.rlim_cur != RLIM_INFINITY)
        fprintf(stderr, ": ulimit -v is %llu KiB; raise it (ulimit -v unlimited), and limit resident memory instead",
                (unsigned long long)limit.rlim_cur / 1024);
    fputc('\n', stderr);
    return 0;
}

enum { LONGEST_PATH = 4096, MOST_LAUNCHED = 4096 };

/* Could another process's memory be read? Containers often forbid it, and Open MPI then complains at every start. */
static int may_read_memory(void)
{
    char from = 1, to = 0;
    const struct iovec local = {&to, 1}, remote = {&from, 1};
    return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) == 1;
}

/* Sets what MPI and the BLAS read from the environment, unless it is set: one thread a rank, as there is one rank a
 * core; no look for GPUs on an X server; and no copies from another process's memory where the system forbids them. */
static void settle_environment(void)
{
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    setenv("OMP_NUM_THREADS", "1", 0);
    setenv("MKL_NUM_THREADS", "1", 0);
    setenv("HWLOC_COMPONENTS", "-gl", 0);
    if (!may_read_memory())
        setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
}

static int is_settled_for_blas;

/* OpenBLAS calls this before main, and then starts its threads. The linker finds ours in place of its own. */
__attribute__((visibility("default"))) void openblas_read_env(void);
void openblas_read_env(void)
{
    void (*const theirs)(void) = (void (*)(void))dlsym(RTLD_NEXT, "openblas_read_env");
    settle_environment();
    is_settled_for_blas = 1;
    if (theirs)
        theirs();
}

/* Another BLAS has read the environment by now: where its threads were not set, the program starts itself again. */
static void settle_environment_of_blas(char **argv)
{
    const int late = !is_settled_for_blas && getenv("OPENBLAS_NUM_THREADS") == NULL;
    settle_environment();
    if (late)
        execv("/proc/self/exe", argv); /* returns only if there is no /proc: then the BLAS keeps its threads */
}

/* Was the process started by mpirun, srun or the like? */
static int is_launched(void)
{
    static const char *const signs[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "MPI_LOCALNRANKS",
                                        "SLURM_STEP_ID"};
    for (size_t s = 0; s < sizeof signs / sizeof signs[0]; s++)
        if (getenv(signs[s]))
            return 1;
    return 0;
}

/* One process talks to nobody, and ranks on one machine talk through its memory. Open MPI is told so, unless its user
 * has chosen otherwise: it looks at every network at its start, which takes longer than a small solve. */
static void leave_networks_alone(void)
{
    const char *ranks = getenv("OMPI_COMM_WORLD_SIZE"), *here = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    const int is_alone = !is_launched();
    if (!is_alone && !(ranks && here && strcmp(ranks, here) == 0))
        return;
    if (is_alone) { /* no daemon beside it, as it never starts others; and no folder, which all that run would share */
        setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
        setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
        setenv("OMPI_MCA_sharedfp", "^sm", 0);
    }
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", is_alone ? "self" : "self,vader", 0);
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

/* `scale` without mpirun becomes mpirun with as many ranks as its list asks for. Returns if there is nothing to start,
 * or nothing to start it with. */
static void launch_scale(int argc, char **argv)
{
    char program[LONGEST_PATH] = "", count[16];
    int command = 1;
    while (command < argc && argv[command][0] == '-') /* -q and -v may come first */
        command++;
    if (command >= argc || strcmp(argv[command], "scale") != 0 || is_launched())
        return;
    const int ranks = ranks_asked_for(argc, argv);
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (ranks < 2 || length <= 0)
        return;
    char **words = calloc((size_t)argc + 4, sizeof *words);
    if (!words)
        return;
    snprintf(count, sizeof count, "%d", ranks);
    char *const start[] = {"mpirun", "-n", count, program};
    for (size_t i = 0; i < 4; i++)
        words[i] = start[i];
    for (int i = 1; i < argc; i++)
        words[3 + i] = argv[i];
    /* More ranks than cores are meant (Open MPI 4 and 5), and so is root, who has started this program, which itself
     * says what fails. */
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
    setenv("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe", 0);
    setenv("OMPI_MCA_orte_execute_quiet", "1", 0);
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
    if (isatty(STDERR_FILENO))
        setenv("ORTHOSTAT_ON_TERMINAL", "1", 0);
    execvp("mpirun", words);
    perror("orthostat: mpirun could not be started; there is one rank");
    free(words);
}

int main(int argc, char **argv)
{
    settle_environment_of_blas(argv);
    setvbuf(stdout, NULL, _IOLBF, 0); /* in a log, warnings stand between its lines and where they belong */
    launch_scale(argc, argv);
    leave_networks_alone();
    const OstLogLevel level = take_level(&argc, &argv);
    const int answered = answer_at_once(argc, argv);
    if (answered >= 0)
        return end_with(answered);
    if (!has_room_to_start())
        return ost_status_exit_code(OST_OUT_OF_MEMORY);
    ost_keep_freed_memory();
    if (MPI_Init(&argc, &argv) != MPI_SUCCESS) {
        fputs("orthostat: error: MPI could not be started\n", stderr);
        return 1;
    }
    OstContext *ctx = NULL;
    int exit_code = 1;
    if (ost_context_create(MPI_COMM_WORLD, &ctx) == OST_SUCCESS) {
        ost_log_set_level(ctx, level);
        ost_end_when_interrupted(ost_rank(ctx) == 0);
        ost_progress_start(ctx);
        exit_code = run_command(ctx, argc, argv);
    } else {
        fputs("orthostat: error: out of memory at the start\n", stderr);
    }
    exit_code = end_with(exit_code);
    ost_progress_end();
    ost_work_is_over();
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return exit_code;
}

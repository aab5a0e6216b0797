/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/free_memory.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The number after `key` in a file of lines "key value"; with key NULL the file's first number. INFINITY if there is
 * none: a control group without a limit says "max". */
static double number_in(const char *path, const char *key)
{
    FILE *file = fopen(path, "r");
    char line[256];
    double found = INFINITY;
    const size_t length = key ? strlen(key) : 0;
    while (file && !isfinite(found) && fgets(line, sizeof line, file))
        if (!key || strncmp(line, key, length) == 0)
            if (sscanf(line + length, "%lf", &found) != 1)
                found = INFINITY;
    if (file)
        fclose(file);
    return found;
}

static const char group_limit[] = "/sys/fs/cgroup/memory.max";
static const char older_group_limit[] = "/sys/fs/cgroup/memory/memory.limit_in_bytes";

/* What a control group (a container, a job of a batch system) may still allocate. Its inactive file cache counts as
 * free, since the kernel drops that on demand. */
static double left_in_group(const char *most, const char *used, const char *statistics, const char *cache)
{
    const double limit = number_in(most, NULL);
    if (!isfinite(limit))
        return INFINITY;
    const double inactive = number_in(statistics, cache);
    return limit - number_in(used, NULL) + (isfinite(inactive) ? inactive : 0.0);
}

/* Free memory by the kernel's estimate and the control groups' limits; INFINITY without /proc. */
static double free_here(void)
{
    const double machine = 1024.0 * number_in("/proc/meminfo", "MemAvailable:");
    const double group =
        left_in_group(group_limit, "/sys/fs/cgroup/memory.current", "/sys/fs/cgroup/memory.stat", "inactive_file ");
    const double older = left_in_group(older_group_limit, "/sys/fs/cgroup/memory/memory.usage_in_bytes",
                                       "/sys/fs/cgroup/memory/memory.stat", "total_inactive_file ");
    return fmax(fmin(machine, fmin(group, older)), 0.0);
}

/* A communicator of this machine's ranks, and this rank's number in it. First returns freed memory to the system, so
 * that it counts as free. */
static OstStatus share_machine(OstContext *ctx, MPI_Comm *machine, int *rank)
{
    ost_return_freed_memory();
    OST_TRY(
        OST_MPI(ctx, MPI_Comm_split_type(ost_comm(ctx), MPI_COMM_TYPE_SHARED, ost_rank(ctx), MPI_INFO_NULL, machine)));
    return OST_MPI(ctx, MPI_Comm_rank(*machine, rank));
}

OstStatus ost_memory_demand(OstContext *ctx, double mine, OstMemoryDemand *demand)
{
    MPI_Comm machine;
    int rank = 0;
    OST_TRY(share_machine(ctx, &machine, &rank));
    double here = free_here(); /* ranks read it at different moments: the least value counts */
    OstStatus status = OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_SUM, machine));
    OST_THEN(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_DOUBLE, MPI_MIN, machine)));
    MPI_Comm_free(&machine);
    OST_TRY(ost_agree(ctx, status));
    struct {
        double shortage;
        int rank;
    } worst = {mine - here, ost_rank(ctx)};
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ost_comm(ctx))));
    double both[2] = {mine, here};
    OST_TRY(OST_MPI(ctx, MPI_Bcast(both, 2, MPI_DOUBLE, worst.rank, ost_comm(ctx))));
    *demand = (OstMemoryDemand){.wanted = both[0], .free = both[1]};
    return OST_SUCCESS;
}

/* Sums a number over the machines. */
static OstStatus sum_machines(OstContext *ctx, double (*of_machine)(void), double *bytes)
{
    MPI_Comm machine;
    int rank = 0;
    OST_TRY(share_machine(ctx, &machine, &rank));
    MPI_Comm_free(&machine);
    *bytes = rank == 0 ? of_machine() : 0.0;
    return ost_sum(ctx, 1, bytes);
}

OstStatus ost_memory_free(OstContext *ctx, double *bytes)
{
    return sum_machines(ctx, free_here, bytes);
}

/* A container's limit may be below its machine's memory. */
static double installed_here(void)
{
    const double machine = 1024.0 * number_in("/proc/meminfo", "MemTotal:");
    return fmin(machine, fmin(number_in(group_limit, NULL), number_in(older_group_limit, NULL)));
}

OstStatus ost_memory_installed(OstContext *ctx, double *bytes)
{
    return sum_machines(ctx, installed_here, bytes);
}

OstStatus ost_memory_foresee(OstContext *ctx, double bytes, const char *who)
{
    void *tried = bytes <= free_here() ? malloc((size_t)bytes + 1) : NULL;
    const int fits = tried != NULL;
    free(tried);
    if (fits)
        return ost_agree(ctx, OST_SUCCESS);
    return ost_agree(ctx, OST_RAISE(ctx, OST_OUT_OF_MEMORY,
                                    "%s would need another %.1f MiB on rank %d, which has not that much free; use more "
                                    "machines or a smaller mesh",
                                    who, bytes / 0x1p20, ost_rank(ctx)));
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "core/error.h"

#include <stdio.h>
#include <unistd.h>

/* A container's limit, which may be less than the machine has; 1e300 if there is none. */
static double container_limit(void)
{
    static const char *const files[] = {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        FILE *file = fopen(files[f], "r");
        double bytes = 0.0;
        if (!file)
            continue;
        const int found = fscanf(file, "%lf", &bytes) == 1 && bytes > 0.0;
        fclose(file);
        if (found)
            return bytes;
    }
    return 1e300;
}

static double this_machine(void)
{
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page = sysconf(_SC_PAGESIZE);
    const double physical = pages > 0 && page > 0 ? (double)pages * (double)page : 1e300;
    const double limit = container_limit();
    return physical < limit ? physical : limit;
}

OstStatus ost_cost_machine_bytes(OstContext *ctx, double *bytes)
{
    MPI_Comm machine;
    int ranks = 1;
    OST_TRY(OST_MPI(ctx, MPI_Comm_split_type(ost_comm(ctx), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine)));
    OST_TRY(OST_MPI(ctx, MPI_Comm_size(machine, &ranks)));
    OST_TRY(OST_MPI(ctx, MPI_Comm_free(&machine)));
    *bytes = this_machine() / ranks;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    return OST_SUCCESS;
}

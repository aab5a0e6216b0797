/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/orthostat.h"
#include "problem/scene_data.h"
#include "system_matrix.h"

#include <stdio.h>

/* Writes the linear system of a case for scripts/bench-peers: FOLDER/system.RANK (system_file.h). */
int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    if (argc != 3 || ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS) {
        fputs("usage: bench_write_system CASE FOLDER\n", stderr);
        return 2;
    }
    const OstStatus status = ost_bench_write_system(ctx, argv[1], argv[2]);
    if (status != OST_SUCCESS && ost_rank(ctx) == 0)
        fprintf(stderr, "%s\n", ost_error_text(ctx));
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}

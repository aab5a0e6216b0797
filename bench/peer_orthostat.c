/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"
#include "core/error.h"
#include "core/memory.h"
#include "orthostat/orthostat.h"
#include "problem/scene_data.h"
#include "process_cost.h"
#include "system_matrix.h"

#include <stdio.h>
#include <stdlib.h>

/* Solves a system of bench_write_system by Orthostat's own metric method, in a process that holds what a peer's holds:
 * the matrix, the right-hand side, the modes. Arguments: folder, name of the solution, tolerance (1e-8). Prints a line
 * of JSON. */

typedef struct Run {
    double setup, solve;
    double setup_processor, solve_processor; /* of the rank that took most */
    double memory[2];                        /* resident before, at the peak; summed over the ranks */
    OstSolveReport report;
    int solved;
} Run;

static double seconds_of_all(void)
{
    MPI_Barrier(MPI_COMM_WORLD);
    return MPI_Wtime();
}

static void measure_ranks(Run *run)
{
    run->memory[1] = peak_resident_bytes();
    MPI_Allreduce(MPI_IN_PLACE, &run->setup_processor, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &run->solve_processor, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, run->memory, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
}

static OstStatus solve(OstContext *ctx, const OstBlockMatrix *matrix, const SystemFile *system, double tolerance,
                       double *u, Run *run)
{
    const OstSolverGeometry geometry = {.coordinates = system->coordinates,
                                        .metric = system->has_metric ? system->metric : NULL,
                                        .modes = system->modes};
    OstSolverOptions options = ost_solver_default_options();
    OstSolver *solver = NULL;
    OstStatus status = OST_SUCCESS;
    options.method = OST_METHOD_METRIC;
    options.relative_residual = tolerance;
    restart_peak_resident();
    run->memory[0] = resident_bytes();
    const double start = seconds_of_all(), start_processor = processor_seconds();
    OST_TRY_DONE(ost_solver_create(ctx, matrix, &geometry, &options, &solver));
    const double middle = seconds_of_all(), middle_processor = processor_seconds();
    const OstStatus solved = ost_solver_solve(solver, system->right_side, u, &run->report);
    run->solve = seconds_of_all() - middle;
    run->solve_processor = processor_seconds() - middle_processor;
    run->setup = middle - start;
    run->setup_processor = middle_processor - start_processor;
    run->solved = solved == OST_SUCCESS;
    status = solved == OST_NOT_CONVERGED ? OST_SUCCESS : solved;
    measure_ranks(run);
done:
    ost_solver_destroy(&solver);
    return status;
}

static void print_run(const Run *run)
{
    printf("{\"setup\": %.6f, \"solve\": %.6f, \"setup_processor\": %.6f, \"solve_processor\": %.6f, "
           "\"iterations\": %d, \"converged\": %s, \"resident_before\": %.0f, \"peak\": %.0f, \"levels\": %d, "
           "\"operator_complexity\": %.3f}\n",
           run->setup, run->solve, run->setup_processor, run->solve_processor, run->report.iterations,
           run->solved ? "true" : "false", run->memory[0], run->memory[1], run->report.levels,
           run->report.operator_complexity);
}

static OstStatus solve_file(OstContext *ctx, const char *folder, const char *name, double tolerance)
{
    SystemFile system = {0};
    OstBlockMatrix *matrix = NULL;
    double *u = NULL;
    char failure[SYSTEM_FAILURE];
    Run run = {0};
    OstStatus status = OST_SUCCESS;
    if (system_file_read(folder, ost_rank(ctx), &system, failure) != 0)
        status = OST_RAISE(ctx, OST_FILE_FAILED, "%s", failure);
    else if (system.ranks != ost_size(ctx))
        status = OST_RAISE(ctx, OST_INVALID_INPUT, "%s is of %d ranks, and these are %d", folder, (int)system.ranks,
                           ost_size(ctx));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_bench_matrix(ctx, &system, &matrix));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &u, 3 * (size_t)system.rows)));
    free(system.value); /* the matrix has them now */
    system.value = NULL;
    OST_TRY_DONE(solve(ctx, matrix, &system, tolerance, u, &run));
    if (system_solution_write(folder, name, ost_rank(ctx), system.rows, u, failure) != 0)
        status = OST_RAISE(ctx, OST_FILE_FAILED, "%s", failure);
    OST_TRY_DONE(ost_agree(ctx, status));
    if (ost_rank(ctx) == 0)
        print_run(&run);
done:
    OST_FREE(u);
    ost_block_matrix_destroy(&matrix);
    system_file_release(&system);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    ost_keep_freed_memory();
    MPI_Init(&argc, &argv);
    if (argc < 3 || ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS) {
        fputs("usage: bench_peer_orthostat FOLDER NAME [TOLERANCE]\n", stderr);
        return 2;
    }
    const OstStatus status = solve_file(ctx, argv[1], argv[2], argc > 3 ? atof(argv[3]) : 1e-8);
    if (status != OST_SUCCESS && ost_rank(ctx) == 0)
        fprintf(stderr, "%s\n", ost_error_text(ctx));
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "problem/problem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Time of the matrix–vector product of a case beside the time that this machine needs to read the same bytes, both the
 * least of several, taking turns. Arguments: case file, repetitions (30). On one rank. */

/* Adds up an array much larger than the caches: what reading alone costs. */
static double read_all(const double *values, size_t count)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    return sum;
}

static double bytes_of_product(const OstBlockMatrix *matrix)
{
    const double blocks = (double)matrix->row_start[matrix->rows];
    return blocks * (9 * sizeof(double) + sizeof(OstLocal)) +
           (double)matrix->rows * (sizeof(OstLocal) + 6 * sizeof(double));
}

static OstStatus time_product(OstContext *ctx, const OstBlockMatrix *matrix, int repetitions)
{
    const size_t columns = 3 * (size_t)matrix->columns;
    const size_t count = (size_t)(bytes_of_product(matrix) / sizeof(double));
    double *x = NULL, *y = NULL, *stream = NULL;
    OST_TRY(OST_NEW(ctx, &x, columns));
    OST_TRY(OST_NEW(ctx, &y, 3 * (size_t)matrix->rows));
    OST_TRY(OST_NEW(ctx, &stream, count));
    for (size_t i = 0; i < columns; i++)
        x[i] = (double)(i % 7) - 3.0;
    for (size_t i = 0; i < count; i++)
        stream[i] = 1.0;
    double product = HUGE_VAL, reading = HUGE_VAL, sum = 0.0;
    for (int r = 0; r < repetitions; r++) {
        double start = ost_seconds();
        OST_TRY(ost_block_matrix_apply(matrix, x, y));
        product = fmin(product, ost_seconds() - start);
        start = ost_seconds();
        sum += read_all(stream, count);
        reading = fmin(reading, ost_seconds() - start);
    }
    printf("%-24s %8.3f ms   %.1f MB, %.1f bytes an unknown\n", "product K u", 1e3 * product,
           1e-6 * bytes_of_product(matrix), bytes_of_product(matrix) / (3.0 * matrix->rows));
    printf("%-24s %8.3f ms   %.1f GB/s; the product runs at %.2f of it (check %g)\n", "reading its bytes",
           1e3 * reading, 1e-9 * bytes_of_product(matrix) / reading, reading / product,
           sum / (double)count / repetitions);
    OST_FREE(x, y, stream);
    return OST_SUCCESS;
}

static OstStatus run(OstContext *ctx, const char *path, int repetitions)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstProblem *problem = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_case_read(ctx, path, &c));
    OST_TRY_DONE(ost_scene_create(c, &scene));
    OST_TRY_DONE(ost_scene_problem(scene, &problem));
    OST_TRY_DONE(ost_problem_stiffness(problem, 1.0, NULL, NULL));
    OST_TRY_DONE(time_product(ctx, problem->system->matrix, repetitions));
done:
    ost_problem_destroy(&problem);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    if (argc < 2 || ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS) {
        fputs("usage: bench_product CASE [REPETITIONS]\n", stderr);
        return 2;
    }
    const OstStatus status = run(ctx, argv[1], argc > 2 ? atoi(argv[2]) : 30);
    if (status != OST_SUCCESS)
        fprintf(stderr, "%s\n", ost_error_text(ctx));
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}

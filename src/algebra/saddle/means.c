/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/means.h"

#include "algebra/krylov/precondition.h"
#include "algebra/saddle/parts.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

extern void dpotrf_(const char *uplo, const int *n, double *a, const int *leading, int *info, size_t length);
extern void dpotrs_(const char *uplo, const int *n, const int *columns, const double *a, const int *leading, double *b,
                    const int *leading_b, int *info, size_t length);

/* A part is looked at where the diagonal of A says that its mean is so soft, and kept where the preconditioner says so.
 * One that nothing holds at all is an enclosed incompressible body, whose mean pressure is free. A little of the
 * diagonal keeps rounding from making the small matrix indefinite. */
static const double looks_soft = 1e-4, is_soft = 0.1, is_free = 1e-20, little = 1e-12;
enum { MOST_PARTS = 256 };

struct OstSoftMeans {
    OstContext *ctx;
    OstLocal rows;
    OstPressureParts parts;
    double *matrix; /* count × count: Z'S Z, then its Cholesky factor; scaled by its diagonal */
    double *scale;  /* count: 1 / root of the diagonal; 0: the part is left out */
    double *sums;   /* count */
};

void ost_soft_means_destroy(OstSoftMeans **means)
{
    if (!*means)
        return;
    ost_pressure_parts_clear(&(*means)->parts);
    OST_FREE((*means)->matrix);
    OST_FREE((*means)->scale);
    OST_FREE((*means)->sums);
    OST_FREE(*means);
}

/* Vectors that a column of the matrix takes. */
typedef struct Column {
    double *p, *q;          /* pressures, with ghosts; of rows */
    double *force, *scaled; /* of displacements */
    double *u;              /* with ghosts */
} Column;

/* This rank's share of Z'B N^-1 B'z of part c. */
static OstStatus find_column(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                             const OstCoupling *coupling, const Column *column, int c, OstSoftMeans *means)
{
    const int *part = means->parts.of_pressure;
    double *sums = means->matrix + (size_t)c * (size_t)means->parts.count;
    for (OstLocal i = 0; i < coupling->columns; i++)
        column->p[i] = part[i] == c;
    OST_TRY(ost_coupling_transpose(coupling, column->p, column->force));
    OST_TRY(ost_precondition(system, preconditioner, column->force, column->scaled, column->u));
    OST_TRY(ost_halo_import(system->matrix->halo, 3 * sizeof *column->u, column->u));
    ost_coupling_multiply(coupling, column->u, column->q);
    for (OstLocal i = 0; i < coupling->rows; i++)
        if (part[i] >= 0)
            sums[part[i]] += column->q[i];
    return OST_SUCCESS;
}

static OstStatus find_matrix(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                             const OstCoupling *coupling, OstSoftMeans *means)
{
    const size_t n = 3 * (size_t)coupling->unknowns, wide = 3 * (size_t)system->matrix->columns;
    const int count = means->parts.count;
    double *memory = NULL;
    OST_TRY(ost_agree(means->ctx,
                      OST_NEW(means->ctx, &memory, 2 * n + wide + (size_t)coupling->columns + (size_t)coupling->rows)));
    const Column column = {.force = memory,
                           .scaled = memory + n,
                           .u = memory + 2 * n,
                           .p = memory + 2 * n + wide,
                           .q = memory + 2 * n + wide + coupling->columns};
    OstStatus status = OST_SUCCESS;
    for (int c = 0; c < count && status == OST_SUCCESS; c++)
        status = find_column(system, preconditioner, coupling, &column, c, means);
    OST_FREE(memory);
    OST_TRY(status);
    return ost_sum(means->ctx, count * count, means->matrix);
}

/* Adds C, and scales by the diagonal. Returns how many parts are soft. */
static int scale(OstSoftMeans *means)
{
    const size_t count = (size_t)means->parts.count;
    int soft = 0;
    for (size_t c = 0; c < count; c++) {
        const double held = means->matrix[c * (count + 1)] + means->parts.loose[c];
        const double share = held / means->parts.mass[c];
        const int is_kept = share > is_free && share < is_soft;
        means->matrix[c * (count + 1)] = held;
        means->scale[c] = is_kept ? 1.0 / sqrt(held) : 0.0;
        soft += is_kept;
    }
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j <= i; j++) {
            const double mean = 0.5 * (means->matrix[i * count + j] + means->matrix[j * count + i]);
            means->matrix[i * count + j] = means->matrix[j * count + i] = mean * means->scale[i] * means->scale[j];
        }
    for (size_t i = 0; i < count; i++)
        means->matrix[i * (count + 1)] = 1.0 + little;
    return soft;
}

/* Without what one part does to another, if the matrix is not positive definite with it. */
static void factor(OstSoftMeans *means)
{
    const int count = means->parts.count;
    int info = 0;
    dpotrf_("L", &count, means->matrix, &count, &info, 1);
    if (info == 0)
        return;
    memset(means->matrix, 0, (size_t)count * (size_t)count * sizeof *means->matrix);
    for (size_t i = 0; i < (size_t)count; i++)
        means->matrix[i * ((size_t)count + 1)] = 1.0;
}

static OstStatus create(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstCoupling *coupling,
                        OstSoftMeans *means, int *soft)
{
    OstContext *ctx = coupling->ctx;
    means->ctx = ctx;
    means->rows = coupling->rows;
    OST_TRY(ost_pressure_parts_create(system->matrix, coupling, looks_soft, MOST_PARTS, &means->parts));
    const size_t count = (size_t)means->parts.count;
    if (count == 0)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(ctx, &means->matrix, count * count);
    OST_THEN(OST_NEW(ctx, &means->scale, count));
    OST_THEN(OST_NEW(ctx, &means->sums, count));
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(find_matrix(system, preconditioner, coupling, means));
    *soft = scale(means);
    factor(means);
    ost_log(ctx, OST_LOG_VERBOSE, "solver: mean pressures of %d soft parts are solved for on their own", *soft);
    return OST_SUCCESS;
}

OstStatus ost_soft_means_create(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                                const OstCoupling *coupling, OstSoftMeans **means)
{
    int soft = 0;
    *means = NULL;
    OST_TRY(ost_agree(coupling->ctx, OST_NEW(coupling->ctx, means, 1)));
    const OstStatus status = create(system, preconditioner, coupling, *means, &soft);
    if (status != OST_SUCCESS || soft == 0)
        ost_soft_means_destroy(means);
    return status;
}

OstStatus ost_soft_means_add(const OstSoftMeans *means, const double *r, double *z)
{
    const int count = means->parts.count, one = 1;
    const int *part = means->parts.of_pressure;
    double *sums = means->sums;
    int info = 0;
    memset(sums, 0, (size_t)count * sizeof *sums);
    for (OstLocal i = 0; i < means->rows; i++)
        if (part[i] >= 0)
            sums[part[i]] += r[i];
    OST_TRY(ost_sum(means->ctx, count, sums));
    for (int c = 0; c < count; c++)
        sums[c] *= means->scale[c];
    dpotrs_("L", &count, &one, means->matrix, &count, sums, &count, &info, 1);
    if (info != 0)
        return OST_RAISE(means->ctx, OST_LIBRARY_FAILED, "LAPACK's dpotrs returned %d", info);
    for (OstLocal i = 0; i < means->rows; i++)
        if (part[i] >= 0)
            z[i] += means->scale[part[i]] * sums[part[i]];
    return OST_SUCCESS;
}

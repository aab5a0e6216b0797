/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/energy_error.h"

#include "algebra/exact_residual.h"
#include "core/error.h"
#include "core/memory.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef struct Work {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    size_t n;         /* unknowns this rank owns */
    double *u;        /* with room for ghosts */
    double *residual; /* then scaled */
    double *corrected;
} Work;

/* f - A u; fills u's ghosts. */
static OstStatus find_residual(Work *work, const double *f, int exact)
{
    const OstBlockMatrix *matrix = work->system->matrix;
    if (exact)
        return ost_exact_residual(matrix, f, work->u, work->residual);
    OST_TRY(ost_block_matrix_apply(matrix, work->u, work->residual));
    for (size_t i = 0; i < work->n; i++)
        work->residual[i] = f[i] - work->residual[i];
    return OST_SUCCESS;
}

/* 1 or -1, as an unknown's global number has it (the finaliser of SplitMix64). */
static double sign_of(OstGlobal unknown)
{
    uint64_t bits = (uint64_t)unknown + UINT64_C(0x9e3779b97f4a7c15);
    bits = (bits ^ (bits >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    bits = (bits ^ (bits >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (bits ^ (bits >> 31)) & 1 ? 1.0 : -1.0;
}

/* What rounding the terms of a row leaves of them, each at random. */
static void find_rounding(Work *work)
{
    const OstBlockMatrix *matrix = work->system->matrix;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        double square[3] = {0.0};
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++)
            for (int i = 0; i < 9; i++) {
                const double term =
                    matrix->value[9 * (size_t)k + (size_t)i] * work->u[3 * (size_t)matrix->column[k] + (size_t)(i % 3)];
                square[i / 3] += term * term;
            }
        for (int i = 0; i < 3; i++)
            work->residual[3 * (size_t)row + (size_t)i] =
                DBL_EPSILON * sign_of(3 * (matrix->first_row + row) + i) * sqrt(square[i]);
    }
}

/* sqrt(r·M^-1 r), r brought to order 1: preconditioners work in single precision too. */
static OstStatus find_norm(Work *work, double *norm)
{
    OstContext *ctx = work->system->matrix->ctx;
    double size, product = 0.0;
    if (work->system->scaling)
        ost_scaling_to_scaled(work->system->scaling, work->residual, work->residual);
    OST_TRY(ost_vector_size(ctx, work->n, work->residual, &size));
    for (size_t i = 0; i < work->n; i++)
        work->residual[i] /= size;
    OST_TRY(work->preconditioner->apply(work->preconditioner->data, work->residual, work->corrected));
    for (size_t i = 0; i < work->n; i++)
        product += work->residual[i] * work->corrected[i];
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &product, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    *norm = size * sqrt(fabs(product));
    return OST_SUCCESS;
}

static OstStatus estimate(Work *work, double smallest, const double *f, int exact, OstEnergyError *error)
{
    OstContext *ctx = work->system->matrix->ctx;
    double energy = 0.0;
    OST_TRY(find_residual(work, f, exact));
    OST_TRY(find_norm(work, &error->residual));
    find_rounding(work);
    OST_TRY(find_norm(work, &error->rounding));
    for (size_t i = 0; i < work->n; i++)
        energy += f[i] * work->u[i];
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &energy, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    const double scale = energy > 0.0 ? sqrt(smallest * energy) : 0.0;
    error->residual = scale > 0.0 ? error->residual / scale : INFINITY;
    error->rounding = scale > 0.0 ? error->rounding / scale : INFINITY;
    return OST_SUCCESS;
}

OstStatus ost_energy_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                           const double *f, const double *u, int exact, OstEnergyError *error)
{
    const OstBlockMatrix *matrix = system->matrix;
    OstContext *ctx = matrix->ctx;
    Work work = {.system = system, .preconditioner = preconditioner, .n = 3 * (size_t)matrix->rows};
    OstStatus status = OST_NEW(ctx, &work.u, 3 * (size_t)matrix->columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &work.residual, work.n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &work.corrected, work.n);
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS) {
        memcpy(work.u, u, work.n * sizeof *u);
        status = estimate(&work, smallest, f, exact, error);
    }
    OST_FREE(work.u);
    OST_FREE(work.residual);
    OST_FREE(work.corrected);
    return status;
}

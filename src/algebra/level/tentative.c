/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/tentative.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

/* A mode is linearly dependent on the others if orthogonalisation leaves less than this of it. */
static const double dependent = 1e-10;

void ost_tentative_destroy(OstTentative **tentative)
{
    if (!*tentative)
        return;
    OST_FREE((*tentative)->coarse, (*tentative)->block, (*tentative)->rest, (*tentative)->modes);
    OST_FREE(*tentative);
}

/* Makes q orthogonal to the orthonormal vectors before it; two passes are enough (Kahan, in Parlett 1980). */
static void orthogonalise(size_t n, int before, const double *basis, double *restrict q, double *r)
{
    for (int pass = 0; pass < 2; pass++)
        for (int d = 0; d < before; d++) {
            const double *restrict other = basis + (size_t)d * n;
            const double share = ost_dot(n, other, q);
            r[d] += share;
            for (size_t i = 0; i < n; i++)
                q[i] -= share * other[i];
        }
}

/* Gram-Schmidt: basis = Q R, n × OST_MODES; Q overwrites basis, column c of R is r + OST_MODES c. */
static void factor_modes(size_t n, double *basis, double *r)
{
    memset(r, 0, OST_MODES * OST_MODES * sizeof *r);
    for (int c = 0; c < OST_MODES; c++) {
        double *q = basis + (size_t)c * n;
        const double whole = sqrt(ost_dot(n, q, q));
        orthogonalise(n, c, basis, q, r + OST_MODES * c);
        const double left = sqrt(ost_dot(n, q, q));
        const double factor = left > dependent * whole ? 1.0 / left : 0.0;
        r[OST_MODES * c + c] = factor > 0.0 ? left : 0.0;
        for (size_t i = 0; i < n; i++)
            q[i] *= factor;
    }
}

/* Makes coarse node a of the aggregate with nodes member[0 .. count - 1]; `basis` is scratch. */
static void make_coarse_node(const OstDoubleMatrix *matrix, const double *modes, OstLocal a, OstLocal count,
                             const OstLocal *member, double *basis, OstTentative *tentative)
{
    const size_t size = (size_t)matrix->size, n = size * (size_t)count, fine = size * (size_t)matrix->rows;
    double r[OST_MODES * OST_MODES];
    for (size_t c = 0; c < OST_MODES; c++)
        for (size_t m = 0; m < (size_t)count; m++)
            memcpy(basis + c * n + size * m, modes + c * fine + size * (size_t)member[m], size * sizeof *basis);
    factor_modes(n, basis, r);
    for (size_t m = 0; m < (size_t)count; m++) {
        float *block = tentative->block + size * OST_MODES * (size_t)member[m];
        tentative->coarse[member[m]] = tentative->first_coarse + a;
        for (size_t i = 0; i < size; i++)
            for (size_t c = 0; c < OST_MODES; c++) {
                const double value = basis[c * n + size * m + i];
                block[OST_MODES * i + c] = (float)value;
                if (tentative->rest)
                    tentative->rest[OST_MODES * (size * (size_t)member[m] + i) + c] =
                        (float)(value - (double)(float)value);
            }
    }
    for (size_t c = 0; c < OST_MODES; c++)
        memcpy(tentative->modes + OST_MODES * (c * (size_t)tentative->coarse_nodes + (size_t)a), r + OST_MODES * c,
               OST_MODES * sizeof *r);
}

static OstStatus make_coarse_nodes(const OstDoubleMatrix *matrix, const OstAggregates *aggregates, const double *modes,
                                   int precise, OstTentative *tentative)
{
    OstContext *ctx = matrix->ctx;
    const size_t size = (size_t)matrix->size;
    OstLocal *start = NULL, *member = NULL;
    double *basis = NULL;
    OstLocal largest = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &tentative->coarse, matrix->columns));
    OST_TRY_DONE(OST_NEW(ctx, &tentative->block, size * OST_MODES * (size_t)matrix->columns + OST_PADDING));
    if (precise)
        OST_TRY_DONE(OST_NEW(ctx, &tentative->rest, size * OST_MODES * (size_t)matrix->rows));
    OST_TRY_DONE(OST_NEW(ctx, &tentative->modes, OST_MODES * OST_MODES * (size_t)aggregates->count));
    OST_TRY_DONE(ost_aggregates_list(aggregates, matrix->rows, &start, &member));
    for (OstLocal a = 0; a < aggregates->count; a++)
        largest = start[a + 1] - start[a] > largest ? start[a + 1] - start[a] : largest;
    OST_TRY_DONE(OST_NEW(ctx, &basis, size * OST_MODES * (size_t)largest));
    for (OstLocal i = 0; i < matrix->rows; i++)
        tentative->coarse[i] = -1;
    for (OstLocal a = 0; a < aggregates->count; a++)
        make_coarse_node(matrix, modes, a, start[a + 1] - start[a], member + start[a], basis, tentative);
done:
    OST_FREE(start, member, basis);
    return status;
}

OstStatus ost_tentative_create(const OstDoubleMatrix *matrix, const OstAggregates *aggregates, const double *modes,
                               int precise, OstTentative **tentative)
{
    OstContext *ctx = matrix->ctx;
    const OstGlobal count = aggregates->count;
    const size_t block_bytes = (size_t)matrix->size * OST_MODES * sizeof(float);
    OstGlobal end = 0;
    OstTentative *made = NULL;
    *tentative = NULL;
    OST_TRY(OST_MPI(ctx, MPI_Scan(&count, &end, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        *made = (OstTentative){.ctx = ctx, .coarse_nodes = aggregates->count, .first_coarse = end - count};
        status = make_coarse_nodes(matrix, aggregates, modes, precise, made);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    status = ost_halo_import(matrix->halo, sizeof *made->coarse, made->coarse);
    OST_THEN(ost_halo_import(matrix->halo, block_bytes, made->block));
    OST_TRY_DONE(ost_agree(ctx, status));
done:
    if (status != OST_SUCCESS)
        ost_tentative_destroy(&made);
    *tentative = made;
    return status;
}

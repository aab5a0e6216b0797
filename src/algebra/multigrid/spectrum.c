/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/spectrum.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/scatter.h"

#include <math.h>
#include <string.h>

enum { STEPS = 10 };

extern void dsterf_(const int *n, double *diagonal, double *below, int *info);

/* Conjugate gradients for A x = noise, for their Lanczos matrix; x is not computed. */
typedef struct Lanczos {
    const OstLevelMatrix *a;
    OstLocalSolve solve;
    const void *data;
    size_t n;
    double *r, *z, *p, *ap;
    int count;
    double diagonal[STEPS], below[STEPS];
} Lanczos;

/* A pseudo-random number in [-1/2, 1/2), by the global number of the unknown alone. */
static double noise(OstGlobal unknown)
{
    return (double)(ost_scatter((uint64_t)unknown) >> 11) * 0x1p-53 - 0.5;
}

static OstStatus run(Lanczos *lanczos)
{
    OstContext *ctx = lanczos->a->ctx;
    const size_t n = lanczos->n;
    const OstGlobal mine = (OstGlobal)n;
    OstGlobal end = 0;
    double weight, energy, alpha = 1.0, beta = 0.0;
    OST_TRY(OST_MPI(ctx, MPI_Scan(&mine, &end, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    for (size_t i = 0; i < n; i++)
        lanczos->r[i] = noise(end - mine + (OstGlobal)i);
    lanczos->solve(lanczos->data, lanczos->r, lanczos->z);
    OST_TRY(ost_vector_dot(ctx, n, lanczos->r, lanczos->z, &weight));
    for (int k = 0; k < STEPS && weight > 0.0; k++) {
        for (size_t i = 0; i < n; i++)
            lanczos->p[i] = lanczos->z[i] + beta * lanczos->p[i];
        memset(lanczos->ap, 0, n * sizeof(double));
        ost_level_matrix_add(lanczos->a, 1.0, lanczos->p, lanczos->ap);
        OST_TRY(ost_vector_dot(ctx, n, lanczos->p, lanczos->ap, &energy));
        if (!(energy > 0.0))
            break;
        const double coupling = beta / alpha;
        alpha = weight / energy;
        for (size_t i = 0; i < n; i++)
            lanczos->r[i] -= alpha * lanczos->ap[i];
        lanczos->solve(lanczos->data, lanczos->r, lanczos->z);
        const double before = weight;
        OST_TRY(ost_vector_dot(ctx, n, lanczos->r, lanczos->z, &weight));
        beta = weight / before;
        lanczos->diagonal[k] = 1.0 / alpha + coupling;
        lanczos->below[k] = sqrt(fmax(beta, 0.0)) / alpha;
        lanczos->count = k + 1;
    }
    return OST_SUCCESS;
}

OstStatus ost_largest_eigenvalue(const OstLevelMatrix *a, OstLocalSolve solve, const void *data, double *largest)
{
    Lanczos lanczos = {.a = a, .solve = solve, .data = data, .n = ost_level_unknowns(a)};
    int info = 0;
    *largest = 1.0;
    /* in one piece, so that what follows r, z and A p is their padding */
    OST_TRY(ost_agree(a->ctx,
                      ost_level_vector_create(a->ctx, a->size, 3 * (size_t)a->rows + (size_t)a->columns, &lanczos.r)));
    lanczos.z = lanczos.r + lanczos.n;
    lanczos.ap = lanczos.z + lanczos.n;
    lanczos.p = lanczos.ap + lanczos.n;
    OstStatus status = ost_agree(a->ctx, run(&lanczos));
    if (status == OST_SUCCESS && lanczos.count > 0) {
        dsterf_(&lanczos.count, lanczos.diagonal, lanczos.below, &info);
        *largest = lanczos.diagonal[lanczos.count - 1];
        if (info != 0)
            status = OST_RAISE(a->ctx, OST_LIBRARY_FAILED, "LAPACK's dsterf returned %d", info);
    }
    OST_FREE(lanczos.r);
    return status;
}

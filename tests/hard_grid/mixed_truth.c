/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rounded_stiffness.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "hard_grid/direct.h"
#include "hard_grid/grid.h"
#include "hard_grid/mixed_exact.h"

#include <string.h>

/* The truth of a mixed form, A u + B' p = f, B u - C p = 0: the residual of both equations, in twice the precision, is
 * solved for by factors until a correction changes nothing that double precision holds. */

enum { MOST_PASSES = 200, FEWEST_ROUNDINGS = 8, MOST_ROUNDINGS = 64, FIRST_ROUNDING = 1000 };

static const double settled = 1e-14;

/* As in truth.c: the effect of rounding the stiffness is sampled where the second correction is above this. */
static const double five_digits = 1e-5;

typedef struct Mixed {
    OstContext *ctx;
    HardDirect direct;
    OstPressureSpace *space;
    OstCoupling *b;
    OstSaddleFactors *factors;
    size_t n, m; /* of this rank's displacements and pressures */
    Twofold *p, *sum;
    double *memory;
    double *ru, *rp, *du, *dp; /* residual, correction; du and dp with ghosts */
    double *z;                 /* of pressures */
} Mixed;

static void clear(Mixed *mixed)
{
    ost_saddle_factors_destroy(&mixed->factors);
    ost_coupling_destroy(&mixed->b);
    ost_pressure_space_destroy(&mixed->space);
    hard_direct_clear(&mixed->direct);
    OST_FREE(mixed->p, mixed->sum, mixed->memory);
}

static OstStatus assemble(const OstScene *scene, Mixed *mixed)
{
    OST_TRY(hard_direct_assemble(scene, &mixed->direct));
    OST_TRY(ost_pressure_space_create(scene->mesh, scene->field, &mixed->space));
    return ost_pressure_coupling(mixed->space, mixed->direct.system, scene->field, &mixed->b);
}

static OstStatus create(const OstScene *scene, Mixed *mixed)
{
    OST_TRY(assemble(scene, mixed));
    OST_TRY(ost_saddle_factors_create(mixed->direct.system->matrix, mixed->b, 0.0, &mixed->factors));
    const size_t n = mixed->n = mixed->direct.n, m = mixed->m = (size_t)mixed->b->rows;
    const size_t columns = 3 * (size_t)mixed->direct.system->matrix->columns, mg = (size_t)mixed->b->columns;
    OstStatus status = OST_NEW(mixed->ctx, &mixed->memory, n + columns + 2 * m + mg);
    OST_THEN(OST_NEW(mixed->ctx, &mixed->p, mg));
    OST_THEN(OST_NEW(mixed->ctx, &mixed->sum, n));
    OST_TRY(ost_agree(mixed->ctx, status));
    mixed->ru = mixed->memory;
    mixed->du = mixed->ru + n;
    mixed->rp = mixed->du + columns;
    mixed->z = mixed->rp + m;
    mixed->dp = mixed->z + m;
    return OST_SUCCESS;
}

/* ru = f - A u - B'p and rp = - B u + C p. */
static OstStatus find_residual(Mixed *mixed)
{
    const OstCoupling *b = mixed->b;
    Twofold *u = mixed->direct.u;
    OST_TRY(ost_halo_import(mixed->direct.system->matrix->halo, 3 * sizeof *u, u));
    OST_TRY(ost_halo_import(b->halo, sizeof *mixed->p, mixed->p));
    for (size_t i = 0; i < mixed->n; i++)
        mixed->sum[i] =
            hard_direct_row(&mixed->direct, (OstLocal)(i / 3), (int)(i % 3), (Twofold){mixed->direct.f[i], 0.0}, u);
    for (OstLocal i = 0; i < b->columns; i++) {
        Twofold sum = {0.0, 0.0};
        for (OstLocal k = b->row_start[i]; k < b->row_start[i + 1]; k++)
            for (size_t c = 0, at = 3 * (size_t)b->column[k]; c < 3; c++, at++) {
                const double value = b->value[3 * (size_t)k + c];
                sum = hard_minus_product(sum, value, u[at]);
                if (at < mixed->n)
                    mixed->sum[at] = hard_minus_product(mixed->sum[at], value, mixed->p[i]);
            }
        if (i >= b->rows)
            continue;
        for (OstLocal k = b->mass_start[i]; k < b->mass_start[i + 1]; k++)
            sum = hard_minus_product(sum, -b->looseness[i] * b->mass[k], mixed->p[b->mass_column[k]]);
        mixed->rp[i] = sum.high + sum.low;
    }
    for (size_t i = 0; i < mixed->n; i++)
        mixed->ru[i] = mixed->sum[i].high + mixed->sum[i].low;
    return OST_SUCCESS;
}

/* Of two lists of pairs: high parts of x (or NULL: 0) less y. */
static OstStatus distance(const Mixed *mixed, size_t n, const double *x, const Twofold *y, double *norm)
{
    *norm = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double apart = (x ? x[i] : 0.0) - y[i].high - y[i].low;
        *norm += apart * apart;
    }
    OST_TRY(ost_sum(mixed->ctx, 1, norm));
    *norm = sqrt(*norm);
    return OST_SUCCESS;
}

static OstStatus correct(Mixed *mixed)
{
    return ost_saddle_factors_solve(mixed->factors, mixed->ru, mixed->rp, mixed->du, mixed->dp);
}

static OstStatus size_of(const Mixed *mixed, double *size, double *of_u, double *of_p)
{
    double pressure;
    OST_TRY(ost_vector_dot(mixed->ctx, mixed->n, mixed->du, mixed->du, of_u));
    OST_TRY(ost_vector_dot(mixed->ctx, mixed->m, mixed->dp, mixed->dp, of_p));
    OST_TRY(distance(mixed, mixed->n, NULL, mixed->direct.u, size));
    OST_TRY(distance(mixed, mixed->m, NULL, mixed->p, &pressure));
    *of_u = sqrt(*of_u) / *size;
    *of_p = sqrt(*of_p) / pressure;
    return OST_SUCCESS;
}

/* How far random samples of rounding errors of the stiffness move the displacement. */
static OstStatus find_rounded(Mixed *mixed, HardTruth *truth)
{
    const OstBlockMatrix *matrix = mixed->direct.system->matrix;
    OstSamples samples = {0, 0.0};
    memset(mixed->rp, 0, mixed->m * sizeof *mixed->rp);
    while (ost_samples_undecided(&samples, hard_hopeless, FEWEST_ROUNDINGS, MOST_ROUNDINGS)) {
        double moved;
        for (size_t i = 0; i < mixed->n; i++)
            mixed->du[i] = mixed->direct.u[i].high;
        OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), mixed->du));
        ost_rounded_stiffness_force(matrix, mixed->du, FIRST_ROUNDING + samples.count, mixed->ru);
        OST_TRY(correct(mixed));
        OST_TRY(ost_vector_dot(mixed->ctx, mixed->n, mixed->du, mixed->du, &moved));
        ost_samples_add(&samples, sqrt(moved) / truth->size);
    }
    truth->rounded = ost_samples_size(&samples);
    return OST_SUCCESS;
}

static OstStatus solve(Mixed *mixed, HardTruth *truth)
{
    double of_u, of_p, second = 0.0;
    memset(mixed->direct.u, 0, mixed->n * sizeof *mixed->direct.u);
    for (int pass = 0; pass < MOST_PASSES && !truth->known; pass++) {
        OST_TRY(find_residual(mixed));
        OST_TRY(correct(mixed));
        for (size_t i = 0; i < mixed->n; i++)
            mixed->direct.u[i] = hard_plus(mixed->direct.u[i], mixed->du[i]);
        for (size_t i = 0; i < mixed->m; i++)
            mixed->p[i] = hard_plus(mixed->p[i], mixed->dp[i]);
        OST_TRY(size_of(mixed, &truth->size, &of_u, &of_p));
        second = pass == 1 ? of_u : second;
        truth->known = of_u <= settled && of_p <= settled;
    }
    return second > five_digits ? find_rounded(mixed, truth) : OST_SUCCESS;
}

/* The energy of the pressures' difference to that of the body. */
static OstStatus compare_pressures(Mixed *mixed, const OstResult *result, double *error)
{
    const OstCoupling *b = mixed->b;
    double sums[2] = {0.0};
    for (size_t i = 0; i < 4 * (size_t)mixed->space->mesh->tet_count; i++)
        if (mixed->space->of_tet[i] >= 0)
            mixed->dp[mixed->space->of_tet[i]] = result->pressure[i];
    for (size_t i = 0; i < mixed->m; i++)
        mixed->dp[i] = mixed->dp[i] - mixed->p[i].high - mixed->p[i].low;
    OST_TRY(ost_coupling_mass(b, mixed->dp, mixed->z));
    for (size_t i = 0; i < mixed->m; i++)
        sums[0] += b->schur[i] * mixed->z[i] * mixed->dp[i];
    for (size_t i = 0; i < mixed->n; i++)
        sums[1] += mixed->direct.f[i] * mixed->direct.u[i].high;
    OST_TRY(ost_sum(mixed->ctx, 2, sums));
    *error = sqrt(sums[0] / sums[1]);
    return OST_SUCCESS;
}

static OstStatus compare(Mixed *mixed, const OstResult *result, HardTruth *truth)
{
    for (size_t i = 0; i < mixed->n; i++)
        mixed->du[i] = result->displacement[3 * (size_t)mixed->direct.system->node_of_row[i / 3] + i % 3];
    OST_TRY(distance(mixed, mixed->n, mixed->du, mixed->direct.u, &truth->error));
    truth->error /= truth->size;
    return compare_pressures(mixed, result, &truth->pressure);
}

OstStatus hard_find_mixed_truth(const OstScene *scene, const OstResult *result, HardTruth *truth)
{
    Mixed mixed = {.ctx = scene->ctx};
    OstStatus status = create(scene, &mixed);
    truth->indefinite = status == OST_SUCCESS && ost_saddle_factors_negative(mixed.factors) > 0;
    OST_THEN(solve(&mixed, truth));
    if (truth->known && result)
        OST_THEN(compare(&mixed, result, truth));
    if (truth->known && result)
        OST_THEN(hard_find_mixed_exact(scene, &(HardMixed){&mixed.direct, mixed.space, mixed.b, mixed.factors}, result,
                                       &truth->off));
    clear(&mixed);
    return status;
}

OstStatus hard_find_mixed_residual(const OstScene *scene, const OstResult *result, HardTruth *truth)
{
    Mixed mixed = {.ctx = scene->ctx};
    OstStatus status = assemble(scene, &mixed);
    OST_THEN(hard_find_mixed_exact_residual(scene, &(HardMixed){&mixed.direct, mixed.space, mixed.b, NULL}, result,
                                            &truth->residual));
    clear(&mixed);
    return status;
}

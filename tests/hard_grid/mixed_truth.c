/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/vector.h"
#include "algebra/saddle/coupling.h"
#include "assembly/pressure/pressure_space.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "hard_grid/direct.h"
#include "hard_grid/grid.h"

#include <string.h>

/* The truth of a mixed form, A u + B' p = f, B u - C p = 0, without the solver under test: u is eliminated by factors
 * of A, conjugate gradients find p, and the residual of both equations, in twice the precision, is solved for again
 * until nothing is gained. */

enum { MOST_PASSES = 40, MOST_STEPS = 400 };

static const double settled = 1e-14, of_pass = 1e-8;

typedef struct Mixed {
    OstContext *ctx;
    HardDirect direct;
    OstPressureSpace *space;
    OstCoupling *b;
    size_t n, m; /* of this rank's displacements and pressures */
    Twofold *p, *sum;
    double *memory;
    double *ru, *rp, *du, *dp;             /* residual, correction; dp with ghosts */
    double *v, *force, *r, *z, *s, *schur; /* of the conjugate gradients: v of A's columns, s with ghosts */
} Mixed;

static void clear(Mixed *mixed)
{
    ost_coupling_destroy(&mixed->b);
    ost_pressure_space_destroy(&mixed->space);
    hard_direct_clear(&mixed->direct);
    OST_FREE(mixed->p);
    OST_FREE(mixed->sum);
    OST_FREE(mixed->memory);
}

static OstStatus create(const OstScene *scene, Mixed *mixed)
{
    OST_TRY(hard_direct_create(scene, &mixed->direct));
    OST_TRY(ost_pressure_space_create(scene->mesh, scene->field, &mixed->space));
    OST_TRY(ost_pressure_coupling(mixed->space, mixed->direct.system, scene->field, &mixed->b));
    const size_t n = mixed->n = mixed->direct.n, m = mixed->m = (size_t)mixed->b->rows;
    const size_t columns = 3 * (size_t)mixed->direct.system->matrix->columns, mg = (size_t)mixed->b->columns;
    OstStatus status = OST_NEW(mixed->ctx, &mixed->memory, 3 * n + columns + 4 * m + 2 * mg);
    OST_THEN(OST_NEW(mixed->ctx, &mixed->p, mg));
    OST_THEN(OST_NEW(mixed->ctx, &mixed->sum, n));
    OST_TRY(ost_agree(mixed->ctx, status));
    mixed->ru = mixed->memory;
    mixed->du = mixed->ru + n;
    mixed->force = mixed->du + n;
    mixed->v = mixed->force + n;
    mixed->rp = mixed->v + columns;
    mixed->r = mixed->rp + m;
    mixed->z = mixed->r + m;
    mixed->schur = mixed->z + m;
    mixed->dp = mixed->schur + m;
    mixed->s = mixed->dp + mg;
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

/* v = A^-1 force by the factors, and y = B v. */
static OstStatus through(Mixed *mixed, const double *force, double *y)
{
    memcpy(mixed->direct.r, force, mixed->n * sizeof *force);
    OST_TRY(hard_direct_apply(&mixed->direct));
    memcpy(mixed->v, mixed->direct.d, mixed->n * sizeof(double));
    OST_TRY(ost_halo_import(mixed->direct.system->matrix->halo, 3 * sizeof(double), mixed->v));
    ost_coupling_multiply(mixed->b, mixed->v, y);
    return OST_SUCCESS;
}

/* schur = (B A^-1 B' + C) s */
static OstStatus multiply(Mixed *mixed)
{
    OST_TRY(ost_coupling_transpose(mixed->b, mixed->s, mixed->force));
    OST_TRY(through(mixed, mixed->force, mixed->schur));
    OST_TRY(ost_coupling_give_way(mixed->b, mixed->s, mixed->z));
    for (size_t i = 0; i < mixed->m; i++)
        mixed->schur[i] += mixed->z[i];
    return OST_SUCCESS;
}

/* du and dp, of the residual at hand; the pressures' conjugate gradients are scaled by the diagonal of M. */
static OstStatus correct(Mixed *mixed)
{
    const OstCoupling *b = mixed->b;
    double weight = 0.0, first = 0.0, energy;
    OST_TRY(through(mixed, mixed->ru, mixed->r));
    for (size_t i = 0; i < mixed->m; i++) {
        mixed->r[i] -= mixed->rp[i];
        mixed->dp[i] = mixed->s[i] = 0.0;
    }
    for (int k = 0; k < MOST_STEPS; k++) {
        const double before = weight;
        for (size_t i = 0; i < mixed->m; i++)
            mixed->z[i] = mixed->r[i] / (b->schur[i] * b->diagonal[i]);
        OST_TRY(ost_vector_dot(mixed->ctx, mixed->m, mixed->r, mixed->z, &weight));
        first = k == 0 ? weight : first;
        if (!(weight > of_pass * of_pass * first))
            break;
        for (size_t i = 0; i < mixed->m; i++)
            mixed->s[i] = mixed->z[i] + (k == 0 ? 0.0 : weight / before) * mixed->s[i];
        OST_TRY(multiply(mixed));
        OST_TRY(ost_vector_dot(mixed->ctx, mixed->m, mixed->s, mixed->schur, &energy));
        if (!(energy > 0.0))
            break;
        for (size_t i = 0; i < mixed->m; i++) {
            mixed->dp[i] += weight / energy * mixed->s[i];
            mixed->r[i] -= weight / energy * mixed->schur[i];
        }
    }
    OST_TRY(ost_coupling_transpose(b, mixed->dp, mixed->force));
    for (size_t i = 0; i < mixed->n; i++)
        mixed->force[i] = mixed->ru[i] - mixed->force[i];
    OST_TRY(through(mixed, mixed->force, mixed->z));
    memcpy(mixed->du, mixed->v, mixed->n * sizeof(double));
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

static OstStatus solve(Mixed *mixed, HardTruth *truth)
{
    double of_u, of_p, size, pressure;
    memset(mixed->direct.u, 0, mixed->n * sizeof *mixed->direct.u);
    for (int pass = 0; pass < MOST_PASSES && !truth->known; pass++) {
        OST_TRY(find_residual(mixed));
        OST_TRY(correct(mixed));
        for (size_t i = 0; i < mixed->n; i++)
            mixed->direct.u[i] = hard_plus(mixed->direct.u[i], mixed->du[i]);
        for (size_t i = 0; i < mixed->m; i++)
            mixed->p[i] = hard_plus(mixed->p[i], mixed->dp[i]);
        OST_TRY(ost_vector_dot(mixed->ctx, mixed->n, mixed->du, mixed->du, &of_u));
        OST_TRY(ost_vector_dot(mixed->ctx, mixed->m, mixed->dp, mixed->dp, &of_p));
        OST_TRY(distance(mixed, mixed->n, NULL, mixed->direct.u, &size));
        OST_TRY(distance(mixed, mixed->m, NULL, mixed->p, &pressure));
        truth->known = sqrt(of_u) <= settled * size && sqrt(of_p) <= settled * pressure;
    }
    truth->size = size;
    return OST_SUCCESS;
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
    OST_THEN(solve(&mixed, truth));
    if (truth->known && result)
        OST_THEN(compare(&mixed, result, truth));
    clear(&mixed);
    return status;
}

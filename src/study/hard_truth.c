/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/mumps.h"
#include "algebra/scaling.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "solve/boundary_conditions.h"
#include "study/hard.h"

#include <math.h>
#include <string.h>

/* Steps of refinement at most, and of inverse iteration for ||K^-1||. */
enum { REFINEMENTS = 60, INVERSE_STEPS = 6 };

/* The solution stands when a correction is no more than this of it. */
static const double settled = 1e-15;

/* An unevaluated sum of two doubles: some 32 digits, of which ill-conditioned equations leave enough. */
typedef struct Twofold {
    double high, low;
} Twofold;

/* a + b, and a - b c; every error of rounding is caught (Dekker, Knuth) but the last ones, of 1e-32. */
static Twofold plus(Twofold a, double b)
{
    const double sum = a.high + b, part = sum - a.high;
    const double low = (a.high - (sum - part)) + (b - part) + a.low;
    const double high = sum + low;
    return (Twofold){high, low - (high - sum)};
}

static Twofold minus_product(Twofold a, double b, Twofold c)
{
    const double product = -b * c.high;
    a = plus(a, product);
    a.low += fma(-b, c.high, -product) - b * c.low;
    return a;
}

/* Equations, factors and solution; sizes are 3 × rows, with ghosts 3 × columns. */
typedef struct Direct {
    OstContext *ctx;
    size_t n;
    OstSupports *supports;
    OstSystem *system;
    OstScaling *scaling;
    OstBlockMatrix *scaled;
    OstMumps *factors;
    double *force, *f;
    Twofold *u;    /* with ghosts: the solution */
    double *r, *d; /* residual; correction, with ghosts */
    double *plain; /* the factors' first solution */
} Direct;

static void release(Direct *direct)
{
    ost_mumps_destroy(&direct->factors);
    ost_block_matrix_destroy(&direct->scaled);
    ost_scaling_destroy(&direct->scaling);
    ost_system_destroy(&direct->system);
    ost_supports_destroy(&direct->supports);
    OST_FREE(direct->force);
    OST_FREE(direct->f);
    OST_FREE(direct->u);
    OST_FREE(direct->r);
    OST_FREE(direct->d);
    OST_FREE(direct->plain);
}

static OstStatus assemble(const OstScene *scene, Direct *direct)
{
    OstContext *ctx = scene->ctx;
    OST_TRY(ost_scene_supports(scene, &direct->supports));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &direct->force, 3 * (size_t)scene->mesh->node_count)));
    OST_TRY(ost_scene_loads(scene, direct->force));
    OST_TRY(ost_system_create(scene->mesh, direct->supports, &direct->system));
    OstStatus status = ost_system_fill(direct->system, scene->field);
    const size_t columns = 3 * (size_t)direct->system->matrix->columns;
    direct->n = 3 * (size_t)direct->system->matrix->rows;
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->f, direct->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->u, columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->r, direct->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->plain, direct->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->d, columns);
    if (status == OST_SUCCESS)
        status = ost_system_right_hand_side(direct->system, scene->field, direct->force, direct->f);
    return ost_agree(ctx, status);
}

static OstStatus factor(Direct *direct)
{
    const OstBlockMatrix *matrix = direct->system->matrix;
    OST_TRY(ost_scaling_create(matrix, &direct->scaling));
    OST_TRY(ost_scaling_apply_matrix(direct->scaling, matrix, &direct->scaled));
    return ost_mumps_create_of_rows(direct->scaled, 0.0, &direct->factors);
}

static OstStatus norm_of(const Direct *direct, const double *v, double *norm)
{
    double square = 0.0;
    for (size_t i = 0; i < direct->n; i++)
        square += v[i] * v[i];
    OST_TRY(OST_MPI(direct->ctx, MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, ost_comm(direct->ctx))));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

/* d = K^-1 r by the factors. */
static OstStatus apply_inverse(Direct *direct)
{
    ost_scaling_to_scaled(direct->scaling, direct->r, direct->r);
    OST_TRY(ost_mumps_solve(direct->factors, direct->r, direct->d));
    ost_scaling_from_scaled(direct->scaling, direct->d, direct->d);
    return OST_SUCCESS;
}

/* r = f - K u, summed in twofold precision. */
static OstStatus find_residual(Direct *direct)
{
    const OstBlockMatrix *k = direct->system->matrix;
    OST_TRY(ost_halo_import(k->halo, 3 * sizeof *direct->u, direct->u));
    for (OstLocal i = 0; i < k->rows; i++)
        for (int c = 0; c < 3; c++) {
            Twofold sum = {direct->f[3 * (size_t)i + (size_t)c], 0.0};
            for (OstLocal b = k->row_start[i]; b < k->row_start[i + 1]; b++) {
                const double *value = k->value + 9 * (size_t)b + 3 * (size_t)c;
                for (int e = 0; e < 3; e++)
                    sum = minus_product(sum, value[e], direct->u[3 * (size_t)k->column[b] + (size_t)e]);
            }
            direct->r[3 * (size_t)i + (size_t)c] = sum.high + sum.low;
        }
    return OST_SUCCESS;
}

static OstStatus solution_norm(Direct *direct, double *norm)
{
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] = direct->u[i].high;
    return norm_of(direct, direct->d, norm);
}

/* Refines from zero; gives up where corrections no longer shrink before the solution stands. */
static OstStatus refine(Direct *direct, OstHardTruth *truth)
{
    double step = 0.0, before = INFINITY;
    truth->known = 0;
    for (int k = 0; k < REFINEMENTS && !truth->known; k++) {
        OST_TRY(find_residual(direct));
        OST_TRY(apply_inverse(direct));
        OST_TRY(norm_of(direct, direct->d, &step));
        if (k == 0)
            memcpy(direct->plain, direct->d, direct->n * sizeof(double));
        for (size_t i = 0; i < direct->n; i++)
            direct->u[i] = plus(direct->u[i], direct->d[i]);
        OST_TRY(solution_norm(direct, &truth->size));
        truth->known = step <= settled * truth->size;
        if (!isfinite(step) || (!truth->known && k > 1 && step > 0.9 * before))
            break;
        before = step;
    }
    return OST_SUCCESS;
}

/* How well u*, rounded to double precision, solves the equations in double precision. */
static OstStatus find_floor(Direct *direct, double f_norm, OstHardTruth *truth)
{
    double norm;
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] = direct->u[i].high;
    OST_TRY(ost_block_matrix_apply(direct->system->matrix, direct->d, direct->r));
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = direct->f[i] - direct->r[i];
    OST_TRY(norm_of(direct, direct->r, &norm));
    truth->floor = norm / f_norm;
    return OST_SUCCESS;
}

/* ||K^-1|| by inverse iteration from a vector that has something of every mode, the same on any ranks. */
static OstStatus find_amplification(Direct *direct, double f_norm, OstHardTruth *truth)
{
    const OstSystem *system = direct->system;
    double norm, inverse = 0.0;
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] =
            1.0 + sin(3.7 * (double)(3 * system->mesh->node_label[system->node_of_row[i / 3]]) + (double)(i % 3));
    for (int k = 0; k < INVERSE_STEPS; k++) {
        OST_TRY(norm_of(direct, direct->d, &norm));
        for (size_t i = 0; i < direct->n; i++)
            direct->r[i] = direct->d[i] / norm;
        OST_TRY(apply_inverse(direct));
        OST_TRY(norm_of(direct, direct->d, &inverse));
    }
    truth->amplification = inverse * f_norm / truth->size;
    return OST_SUCCESS;
}

/* ||v - u*|| / ||u*||, v being in `r`. */
static OstStatus distance(Direct *direct, double size, double *error)
{
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = (direct->r[i] - direct->u[i].high) - direct->u[i].low;
    OST_TRY(norm_of(direct, direct->r, error));
    *error /= size;
    return OST_SUCCESS;
}

static OstStatus find_errors(Direct *direct, const OstResult *result, OstHardTruth *truth)
{
    memcpy(direct->r, direct->plain, direct->n * sizeof(double));
    OST_TRY(distance(direct, truth->size, &truth->plain));
    if (!result)
        return OST_SUCCESS;
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = result->displacement[3 * (size_t)direct->system->node_of_row[i / 3] + i % 3];
    return distance(direct, truth->size, &truth->error);
}

OstStatus ost_hard_find_truth(const OstScene *scene, const OstResult *result, OstHardTruth *truth)
{
    Direct direct = {.ctx = scene->ctx};
    double f_norm;
    *truth = (OstHardTruth){0, NAN, NAN, NAN, NAN, NAN};
    OstStatus status = assemble(scene, &direct);
    if (status == OST_SUCCESS)
        status = factor(&direct);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(norm_of(&direct, direct.f, &f_norm));
    OST_TRY_DONE(refine(&direct, truth));
    if (!truth->known)
        goto done;
    OST_TRY_DONE(find_errors(&direct, result, truth));
    OST_TRY_DONE(find_floor(&direct, f_norm, truth));
    OST_TRY_DONE(find_amplification(&direct, f_norm, truth));
done:
    release(&direct);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rounded_stiffness.h"
#include "core/error.h"
#include "core/memory.h"
#include "hard_grid/direct.h"
#include "hard_grid/exact.h"
#include "hard_grid/grid.h"
#include "hard_grid/singular.h"

#include <math.h>
#include <string.h>

/* Steps of inverse iteration for ||K^-1||; random samples of rounding errors, as many as are needed to decide whether
 * double precision has an answer. */
enum { INVERSE_STEPS = 6, FEWEST_ROUNDINGS = 8, MOST_ROUNDINGS = 256 };

/* Samples with lower numbers are those of the program itself. */
enum { FIRST_ROUNDING = 1000 };

/* Relative size of the last correction: of the solution, and of its change by rounding errors. */
static const double settled = 1e-15, roughly = 1e-2;

/* The effect of rounding K is sampled if the factors' own error is above this. That error is one more sample of
 * rounding errors; it differs from run to run on several ranks, and may be small by chance. */
static const double five_digits = 1e-5;

/* --- the solution --- */

/* How well u*, rounded to double precision, solves the equations in double precision. */
static OstStatus find_floor(HardDirect *direct, double f_norm, HardTruth *truth)
{
    double norm;
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] = direct->u[i].high;
    OST_TRY(ost_block_matrix_apply(direct->system->matrix, direct->d, direct->r));
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = direct->f[i] - direct->r[i];
    OST_TRY(hard_direct_norm(direct, direct->r, &norm));
    truth->floor = norm / f_norm;
    return OST_SUCCESS;
}

/* ||K^-1|| by inverse iteration, from a vector that holds every mode and is the same on any number of ranks. */
static OstStatus find_amplification(HardDirect *direct, double f_norm, HardTruth *truth)
{
    const OstGlobal *label = direct->system->matrix->label;
    double norm, inverse = 0.0;
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] = 1.0 + sin(3.7 * (double)(3 * label[i / 3]) + (double)(i % 3));
    for (int k = 0; k < INVERSE_STEPS; k++) {
        OST_TRY(hard_direct_norm(direct, direct->d, &norm));
        for (size_t i = 0; i < direct->n; i++)
            direct->r[i] = direct->d[i] / norm;
        OST_TRY(hard_direct_apply(direct));
        OST_TRY(hard_direct_norm(direct, direct->d, &inverse));
    }
    truth->amplification = inverse * f_norm / truth->size;
    return OST_SUCCESS;
}

/* ||v - u*|| / ||u*||, v being in `r`. */
static OstStatus distance(HardDirect *direct, double size, double *error)
{
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = (direct->r[i] - direct->u[i].high) - direct->u[i].low;
    OST_TRY(hard_direct_norm(direct, direct->r, error));
    *error /= size;
    return OST_SUCCESS;
}

static OstStatus find_errors(HardDirect *direct, const OstResult *result, const double *plain, HardTruth *truth)
{
    memcpy(direct->r, plain, direct->n * sizeof(double));
    OST_TRY(distance(direct, truth->size, &truth->plain));
    if (!result)
        return OST_SUCCESS;
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = result->displacement[3 * (size_t)direct->system->node_of_row[i / 3] + i % 3];
    return distance(direct, truth->size, &truth->error);
}

/* --- the effect of rounding the stiffness --- */

/* Random samples as the program makes them (tested in tests/algebra/mpi_test_energy_error.c), with other signs, each
 * solved in double-double precision. u is u* with its ghosts; `direct->u` becomes the change by the last sample. */
static OstStatus try_roundings(HardDirect *direct, const double *u, double *force, HardTruth *truth)
{
    OstSamples samples = {0, 0.0};
    int known = 1;
    while (known && ost_samples_undecided(&samples, hard_hopeless, FEWEST_ROUNDINGS, MOST_ROUNDINGS)) {
        double moved;
        ost_rounded_stiffness_force(direct->system->matrix, u, FIRST_ROUNDING + samples.count, force);
        OST_TRY(hard_direct_solve(direct, force, roughly, NULL, &known));
        OST_TRY(hard_direct_size(direct, &moved));
        ost_samples_add(&samples, moved / truth->size);
    }
    truth->rounded = known ? ost_samples_size(&samples) : NAN;
    return OST_SUCCESS;
}

static OstStatus find_rounded(HardDirect *direct, HardTruth *truth)
{
    const OstBlockMatrix *matrix = direct->system->matrix;
    double *u = NULL, *force = NULL;
    OstStatus status = OST_NEW(direct->ctx, &u, 3 * (size_t)matrix->columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(direct->ctx, &force, direct->n);
    OST_TRY_DONE(ost_agree(direct->ctx, status));
    for (size_t i = 0; i < direct->n; i++)
        u[i] = direct->u[i].high;
    OST_TRY_DONE(ost_halo_import(matrix->halo, 3 * sizeof *u, u));
    OST_TRY_DONE(try_roundings(direct, u, force, truth));
done:
    OST_FREE(u, force);
    return status;
}

static OstStatus find_all(HardDirect *direct, const OstResult *result, double *plain, HardTruth *truth)
{
    double f_norm;
    OST_TRY(hard_direct_norm(direct, direct->f, &f_norm));
    OST_TRY(hard_direct_solve(direct, direct->f, settled, plain, &truth->known));
    if (!truth->known)
        return OST_SUCCESS;
    OST_TRY(hard_direct_size(direct, &truth->size));
    OST_TRY(find_errors(direct, result, plain, truth));
    OST_TRY(find_floor(direct, f_norm, truth));
    OST_TRY(find_amplification(direct, f_norm, truth));
    return truth->plain > five_digits ? find_rounded(direct, truth) : OST_SUCCESS;
}

OstStatus hard_find_residual(const OstScene *scene, const OstResult *result, HardTruth *truth)
{
    HardDirect direct;
    OstStatus status = hard_direct_assemble(scene, &direct);
    if (status == OST_SUCCESS)
        status = hard_find_exact_residual(scene, &direct, result, &truth->residual);
    hard_direct_clear(&direct);
    return status;
}

OstStatus hard_find_singular(const OstScene *scene, HardTruth *truth)
{
    HardDirect direct;
    OstStatus status = hard_direct_assemble(scene, &direct);
    OST_THEN(hard_find_softest(scene, &direct, truth));
    hard_direct_clear(&direct);
    return status;
}

OstStatus hard_find_truth(const OstScene *scene, const OstResult *result, HardTruth *truth)
{
    HardDirect direct;
    double *plain = NULL;
    *truth = (HardTruth){0, 0, NAN, {0, NAN, NAN, NAN}, NAN, NAN, NAN, NAN, NAN, truth->residual, NAN};
    OstStatus status;
    status = hard_direct_create(scene, &direct);
    truth->indefinite = status == OST_NOT_CONVERGED; /* even with a little on its diagonal */
    OST_TRY_DONE(status);
    OST_TRY_DONE(ost_agree(scene->ctx, OST_NEW(scene->ctx, &plain, direct.n)));
    OST_TRY_DONE(find_all(&direct, result, plain, truth));
    truth->indefinite = direct.indefinite;
    if (result && result->reaction) /* a refused one may have none */
        OST_TRY_DONE(hard_find_exact(scene, &direct, result, &truth->off));
done:
    OST_FREE(plain);
    hard_direct_clear(&direct);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rounded_stiffness.h"
#include "core/error.h"
#include "core/memory.h"
#include "study/hard.h"
#include "study/hard_direct.h"

#include <math.h>
#include <string.h>

/* Steps of inverse iteration for ||K^-1||; roundings of K tried, as many as it takes to say on which side of hopeless
 * they are. */
enum { INVERSE_STEPS = 6, FEWEST_ROUNDINGS = 8, MOST_ROUNDINGS = 256 };

/* Before it are those that the program itself throws. */
enum { FIRST_ROUNDING = 1000 };

/* The solution stands when a correction is no more than this of it; what a rounding moves is wanted less closely. */
static const double settled = 1e-15, roughly = 1e-2;

/* What rounding K does is worth looking at where the factors leave less than five digits: what they leave is one
 * rounding more, not the same from run to run on several ranks, and may fall short. */
static const double five_digits = 1e-5;

/* --- the solution --- */

/* How well u*, rounded to double precision, solves the equations in double precision. */
static OstStatus find_floor(OstHardDirect *direct, double f_norm, OstHardTruth *truth)
{
    double norm;
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] = direct->u[i].high;
    OST_TRY(ost_block_matrix_apply(direct->system->matrix, direct->d, direct->r));
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = direct->f[i] - direct->r[i];
    OST_TRY(ost_hard_direct_norm(direct, direct->r, &norm));
    truth->floor = norm / f_norm;
    return OST_SUCCESS;
}

/* ||K^-1|| by inverse iteration from a vector that has something of every mode, the same on any ranks. */
static OstStatus find_amplification(OstHardDirect *direct, double f_norm, OstHardTruth *truth)
{
    const OstGlobal *label = direct->system->matrix->label;
    double norm, inverse = 0.0;
    for (size_t i = 0; i < direct->n; i++)
        direct->d[i] = 1.0 + sin(3.7 * (double)(3 * label[i / 3]) + (double)(i % 3));
    for (int k = 0; k < INVERSE_STEPS; k++) {
        OST_TRY(ost_hard_direct_norm(direct, direct->d, &norm));
        for (size_t i = 0; i < direct->n; i++)
            direct->r[i] = direct->d[i] / norm;
        OST_TRY(ost_hard_direct_apply(direct));
        OST_TRY(ost_hard_direct_norm(direct, direct->d, &inverse));
    }
    truth->amplification = inverse * f_norm / truth->size;
    return OST_SUCCESS;
}

/* ||v - u*|| / ||u*||, v being in `r`. */
static OstStatus distance(OstHardDirect *direct, double size, double *error)
{
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = (direct->r[i] - direct->u[i].high) - direct->u[i].low;
    OST_TRY(ost_hard_direct_norm(direct, direct->r, error));
    *error /= size;
    return OST_SUCCESS;
}

static OstStatus find_errors(OstHardDirect *direct, const OstResult *result, const double *plain, OstHardTruth *truth)
{
    memcpy(direct->r, plain, direct->n * sizeof(double));
    OST_TRY(distance(direct, truth->size, &truth->plain));
    if (!result)
        return OST_SUCCESS;
    for (size_t i = 0; i < direct->n; i++)
        direct->r[i] = result->displacement[3 * (size_t)direct->system->node_of_row[i / 3] + i % 3];
    return distance(direct, truth->size, &truth->error);
}

/* --- what rounding the stiffness does to it --- */

/* Throws as the program's own, tested against other roundings (tests/algebra/mpi_test_energy_error.c), of other signs
 * and with a factorisation led to 32 digits. u is u* with its ghosts; that of `direct` becomes the last throw's. */
static OstStatus try_roundings(OstHardDirect *direct, const double *u, double *force, OstHardTruth *truth)
{
    OstSamples throws = {0, 0.0};
    int known = 1;
    while (known && ost_samples_undecided(&throws, ost_hard_hopeless, FEWEST_ROUNDINGS, MOST_ROUNDINGS)) {
        double moved;
        ost_rounded_stiffness_force(direct->system->matrix, u, FIRST_ROUNDING + throws.count, force);
        OST_TRY(ost_hard_direct_solve(direct, force, roughly, NULL, &known));
        OST_TRY(ost_hard_direct_size(direct, &moved));
        ost_samples_add(&throws, moved / truth->size);
    }
    truth->rounded = known ? ost_samples_size(&throws) : NAN;
    return OST_SUCCESS;
}

static OstStatus find_rounded(OstHardDirect *direct, OstHardTruth *truth)
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
    OST_FREE(u);
    OST_FREE(force);
    return status;
}

static OstStatus find_all(OstHardDirect *direct, const OstResult *result, double *plain, OstHardTruth *truth)
{
    double f_norm;
    OST_TRY(ost_hard_direct_norm(direct, direct->f, &f_norm));
    OST_TRY(ost_hard_direct_solve(direct, direct->f, settled, plain, &truth->known));
    if (!truth->known)
        return OST_SUCCESS;
    OST_TRY(ost_hard_direct_size(direct, &truth->size));
    OST_TRY(find_errors(direct, result, plain, truth));
    OST_TRY(find_floor(direct, f_norm, truth));
    OST_TRY(find_amplification(direct, f_norm, truth));
    return truth->plain > five_digits ? find_rounded(direct, truth) : OST_SUCCESS;
}

OstStatus ost_hard_find_truth(const OstScene *scene, const OstResult *result, OstHardTruth *truth)
{
    OstHardDirect direct;
    double *plain = NULL;
    *truth = (OstHardTruth){0, 0, NAN, NAN, NAN, NAN, NAN, NAN};
    OstStatus status;
    status = ost_hard_direct_create(scene, &direct);
    truth->indefinite = status == OST_NOT_CONVERGED; /* even with a little on its diagonal */
    OST_TRY_DONE(status);
    OST_TRY_DONE(ost_agree(scene->ctx, OST_NEW(scene->ctx, &plain, direct.n)));
    OST_TRY_DONE(find_all(&direct, result, plain, truth));
    truth->indefinite = direct.indefinite;
done:
    OST_FREE(plain);
    ost_hard_direct_clear(&direct);
    return status;
}

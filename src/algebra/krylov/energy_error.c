/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/energy_error.h"

#include "algebra/matrix/compensated_residual.h"
#include "algebra/matrix/compensated_step.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

/* Up to this error rounding is not looked at more closely, nor once a throw is no more: one that falls short a
 * hundredfold, as one in a hundred does, still leaves four digits. */
static const double six_digits = 1e-6;

/* As many where the error is near to the least digit. */
enum { FEWEST_SAMPLES = 8, MOST_SAMPLES = 64 };

const double ost_least_digit = 0.1;

/* Little of the energy is where the displacement is, if the two tell errors that differ by more than this. */
static const double hidden_beyond = 10.0;

/* Factors are led (algebra/exact_step.h) until a step is no more than this of the whole. */
static const double roughly = 0.1;

enum { MOST_STEPS = 40 };

typedef struct Work {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    size_t n;                 /* unknowns this rank owns */
    double *u;                /* with room for ghosts */
    double *residual;         /* f - A u */
    double *vector;           /* the one that is measured */
    double *corrected;        /* M^-1 of that */
    OstCompensatedStep *step; /* where factors are led: then also */
    double *left;             /* what of the vector is left to solve for, */
    double *solution;         /* and A^-1 of the rest, over |u| */
    int lost;                 /* is A not positive definite, or does none settle? */
    double smallest;          /* eigenvalue of M^-1 A */
    double energy_norm;       /* |u|_A sqrt(smallest) */
    double displacement;      /* |u| */
    double moved;             /* |M^-1 v| over that, of the last vector that was measured, where M is not factors */
} Work;

/* f - A u; fills u's ghosts. */
static OstStatus find_residual(Work *work, const double *f, int compensated)
{
    const OstBlockMatrix *matrix = work->system->matrix;
    if (compensated)
        return ost_compensated_residual(matrix, f, work->u, work->residual);
    OST_TRY(ost_block_matrix_apply(matrix, work->u, work->residual));
    for (size_t i = 0; i < work->n; i++)
        work->residual[i] = f[i] - work->residual[i];
    return OST_SUCCESS;
}

/* The vector is what a rounding of A leaves of the residual. */
static void sample_rounding(Work *work, int which)
{
    ost_rounded_stiffness_force(work->system->matrix, work->u, which, work->vector);
}

/* M^-1 v; v is divided by `size` before: preconditioners work in single precision too. */
static OstStatus correct(Work *work, double *size)
{
    if (work->system->scaling)
        ost_scaling_to_scaled(work->system->scaling, work->vector, work->vector);
    OST_TRY(ost_vector_size(work->system->matrix->ctx, work->n, work->vector, size));
    for (size_t i = 0; i < work->n; i++)
        work->vector[i] /= *size;
    return work->preconditioner->apply(work->preconditioner->data, work->vector, work->corrected);
}

/* Takes M^-1 v from the scaled unknowns, times a factor. */
static void unscale(Work *work, double factor)
{
    if (work->system->scaling)
        ost_scaling_from_scaled(work->system->scaling, work->corrected, work->corrected);
    for (size_t i = 0; i < work->n; i++)
        work->corrected[i] *= factor;
}

static OstStatus find_norm(const Work *work, const double *v, double *norm)
{
    double square;
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, v, v, &square));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

/* What one application of the preconditioner to v, as a residual, says of the error. */
static OstStatus measure(Work *work, double *error)
{
    double size, square;
    work->moved = 0.0;
    OST_TRY(correct(work, &size));
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, work->vector, work->corrected, &square));
    *error = square == 0.0 ? 0.0 : size * sqrt(square) / work->energy_norm;
    if (!(square > 0.0))
        return OST_SUCCESS;
    unscale(work, size / work->displacement);
    return find_norm(work, work->corrected, work->preconditioner->factors ? error : &work->moved);
}

/* The larger, but NAN stays. */
static double at_least(double error, double other)
{
    return other > error ? other : error;
}

/* The next step towards the solution of what is left, and how far it leads. */
static OstStatus lead(Work *work, double *moved)
{
    double size;
    memcpy(work->vector, work->left, work->n * sizeof(double));
    OST_TRY(correct(work, &size));
    unscale(work, size);
    OST_TRY(ost_compensated_step_turn(work->step, work->left, work->corrected));
    for (size_t i = 0; i < work->n; i++) {
        work->solution[i] += work->corrected[i];
        work->left[i] -= work->step->length * work->step->product[i];
    }
    return find_norm(work, work->corrected, moved);
}

/* The same of A^-1 v, by as many applications as it takes. */
static OstStatus measure_closely(Work *work, double *error)
{
    double moved = INFINITY;
    int indefinite = 0;
    work->step->energy = *error = 0.0;
    for (size_t i = 0; i < work->n; i++) {
        work->left[i] = work->vector[i] / work->displacement; /* and so all that follows */
        work->solution[i] = 0.0;
    }
    for (int k = 0; k < MOST_STEPS && moved > roughly * *error && !indefinite; k++) {
        OST_TRY(lead(work, &moved));
        OST_TRY(find_norm(work, work->solution, error));
        indefinite = work->step->energy == 0.0 && moved > 0.0;
    }
    work->lost = indefinite || !(moved <= roughly * *error);
    return OST_SUCCESS;
}

static OstStatus look(Work *work, double *error)
{
    return work->step ? measure_closely(work, error) : measure(work, error);
}

static int more_samples(const OstSamples *throws)
{
    if (throws->count > 0 && ost_samples_size(throws) <= six_digits)
        return 0;
    return ost_samples_undecided(throws, ost_least_digit, FEWEST_SAMPLES, MOST_SAMPLES);
}

/* The error that the residual leaves. */
static OstStatus look_at_residual(Work *work, OstEnergyError *error)
{
    memcpy(work->vector, work->residual, work->n * sizeof(double));
    OST_TRY(look(work, &error->energy));
    error->hidden = work->moved > hidden_beyond * work->smallest * error->energy;
    error->whole = at_least(error->energy, work->moved / work->smallest);
    return OST_SUCCESS;
}

/* How much a throw moves depends on no eigenvalue: few of its many directions are those of the least one. */
static OstStatus look_closer(Work *work, OstEnergyError *error)
{
    double one;
    OstSamples throws = {0, 0.0};
    OST_TRY(look_at_residual(work, error));
    while (!work->lost && more_samples(&throws)) {
        sample_rounding(work, 1 + throws.count);
        OST_TRY(look(work, &one));
        ost_samples_add(&throws, at_least(one, work->moved));
    }
    if (work->lost)
        return OST_SUCCESS;
    error->rounding = ost_samples_size(&throws);
    error->spread = ost_samples_spread(&throws);
    error->whole = hypot(error->whole, error->rounding);
    error->energy = hypot(error->energy, error->rounding);
    return OST_SUCCESS;
}

/* |u|, whose squares may be too small or too large for a number. */
static OstStatus find_displacement(Work *work)
{
    double size, square;
    OST_TRY(ost_vector_size(work->system->matrix->ctx, work->n, work->u, &size));
    for (size_t i = 0; i < work->n; i++)
        work->vector[i] = work->u[i] / size;
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, work->vector, work->vector, &square));
    work->displacement = size * sqrt(square);
    return OST_SUCCESS;
}

static OstStatus prepare_to_lead(Work *work)
{
    OstContext *ctx = work->system->matrix->ctx;
    OstStatus status = OST_NEW(ctx, &work->left, work->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &work->solution, work->n);
    OST_TRY(ost_agree(ctx, status));
    return ost_compensated_step_create(work->system->matrix, &work->step);
}

static const OstEnergyError unknown = {.whole = INFINITY, .energy = INFINITY, .rounding = INFINITY};

static OstStatus estimate(Work *work, const double *f, int compensated, OstEnergyError *error)
{
    double energy;
    OST_TRY(find_residual(work, f, compensated));
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, f, work->u, &energy));
    *error = unknown;
    work->energy_norm = energy > 0.0 ? sqrt(energy) * sqrt(work->smallest) : 0.0;
    if (!(work->energy_norm > 0.0))
        return OST_SUCCESS;
    OST_TRY(find_displacement(work));
    error->rounding = 0.0;
    sample_rounding(work, 0);
    for (size_t i = 0; i < work->n; i++)
        work->vector[i] += work->residual[i];
    if (compensated && work->preconditioner->factors)
        OST_TRY(prepare_to_lead(work));
    OST_TRY(look(work, &error->energy));
    error->whole = at_least(error->energy, work->moved / work->smallest);
    if (error->whole > six_digits && !work->lost)
        OST_TRY(look_closer(work, error));
    if (work->lost)
        *error = unknown;
    return OST_SUCCESS;
}

static OstStatus allocate(OstContext *ctx, Work *work)
{
    OST_TRY(OST_NEW(ctx, &work->u, 3 * (size_t)work->system->matrix->columns));
    OST_TRY(OST_NEW(ctx, &work->residual, work->n));
    OST_TRY(OST_NEW(ctx, &work->vector, work->n));
    return OST_NEW(ctx, &work->corrected, work->n);
}

OstStatus ost_energy_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                           const double *f, const double *u, int compensated, OstEnergyError *error)
{
    const OstBlockMatrix *matrix = system->matrix;
    Work work = {
        .system = system, .preconditioner = preconditioner, .n = 3 * (size_t)matrix->rows, .smallest = smallest};
    OstStatus status = ost_agree(matrix->ctx, allocate(matrix->ctx, &work));
    if (status == OST_SUCCESS) {
        memcpy(work.u, u, work.n * sizeof *u);
        status = estimate(&work, f, compensated, error);
    }
    OST_FREE(work.u);
    OST_FREE(work.residual);
    OST_FREE(work.vector);
    OST_FREE(work.corrected);
    OST_FREE(work.left);
    OST_FREE(work.solution);
    ost_compensated_step_destroy(&work.step);
    return status;
}

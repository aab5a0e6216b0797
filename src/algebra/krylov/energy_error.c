/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/energy_error.h"

#include "algebra/matrix/compensated_step.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

/* Below this error one random sample is enough: with probability 1 % it underestimates a hundredfold, and four digits
 * remain. */
static const double small_error = 1e-6;

enum { FEWEST_SAMPLES = 8, MOST_SAMPLES = 64 };

const double ost_least_digit = 0.1;

const char *const ost_rounding_remedy =
    "bring the stiffnesses of the materials nearer to each other, constrain the body better, or, if it is slender or "
    "has flat tets, mesh it with larger and rounder ones";

/* The displacement is hidden from the energy norm if the 2-norm tells an error this many times larger. */
static const double hidden_beyond = 10.0;

/* CG preconditioned by factors stops at a step of at most this relative to the solution. */
static const double last_step = 0.1;

enum { MOST_STEPS = 40 };

typedef struct Work {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    size_t n;                 /* unknowns this rank owns */
    double *u;                /* with room for ghosts */
    double *residual;         /* f - A u */
    double *vector;           /* v, the residual to be measured */
    double *corrected;        /* M^-1 v */
    OstCompensatedStep *step; /* NULL unless v is solved by CG preconditioned by factors; then also */
    double *remaining;        /* the residual of that, and */
    double *solution;         /* its solution, both over |u| */
    int failed;               /* that CG found A not positive definite, or did not converge */
    double smallest;          /* eigenvalue of M^-1 A */
    double energy_norm;       /* |u|_A sqrt(smallest) */
    double displacement;      /* |u| */
    double step_size;         /* |M^-1 v| / |u| of the last v; 0 if M is factors */
} Work;

static OstStatus find_norm(const Work *work, const double *v, double *norm)
{
    double square;
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, v, v, &square));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

/* |u|, scaled, as the squares may over- or underflow. */
static OstStatus find_displacement(Work *work)
{
    double size, norm;
    OST_TRY(ost_vector_size(work->system->matrix->ctx, work->n, work->u, &size));
    for (size_t i = 0; i < work->n; i++)
        work->vector[i] = work->u[i] / size;
    OST_TRY(find_norm(work, work->vector, &norm));
    work->displacement = size * norm;
    return OST_SUCCESS;
}

/* corrected = M^-1 v in scaled unknowns, for v divided by `size`: preconditioners work in single precision too. */
static OstStatus precondition(Work *work, double *size)
{
    if (work->system->scaling)
        ost_scaling_to_scaled(work->system->scaling, work->vector, work->vector);
    OST_TRY(ost_vector_size(work->system->matrix->ctx, work->n, work->vector, size));
    for (size_t i = 0; i < work->n; i++)
        work->vector[i] /= *size;
    return work->preconditioner->apply(work->preconditioner->data, work->vector, work->corrected);
}

/* Takes `corrected` to unscaled unknowns, times a factor. */
static void unscale(Work *work, double factor)
{
    if (work->system->scaling)
        ost_scaling_from_scaled(work->system->scaling, work->corrected, work->corrected);
    for (size_t i = 0; i < work->n; i++)
        work->corrected[i] *= factor;
}

/* The error that v, as a residual, leaves, by one application of the preconditioner. */
static OstStatus measure_once(Work *work, double *error)
{
    double size, square;
    work->step_size = 0.0;
    OST_TRY(precondition(work, &size));
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, work->vector, work->corrected, &square));
    *error = square == 0.0 ? 0.0 : size * sqrt(square) / work->energy_norm;
    if (!(square > 0.0))
        return OST_SUCCESS;
    unscale(work, size / work->displacement);
    return find_norm(work, work->corrected, work->preconditioner->factors ? error : &work->step_size);
}

/* The same as |A^-1 v| / |u|, by CG preconditioned by factors. */
static OstStatus measure_by_cg(Work *work, double *error)
{
    OstCompensatedStep *step = work->step;
    double size, moved = INFINITY;
    int indefinite = 0;
    step->energy = *error = 0.0;
    for (size_t i = 0; i < work->n; i++) {
        work->remaining[i] = work->vector[i] / work->displacement;
        work->solution[i] = 0.0;
    }
    for (int k = 0; k < MOST_STEPS && moved > last_step * *error && !indefinite; k++) {
        memcpy(work->vector, work->remaining, work->n * sizeof(double));
        OST_TRY(precondition(work, &size));
        unscale(work, size);
        OST_TRY(ost_compensated_step_turn(step, work->remaining, work->corrected));
        for (size_t i = 0; i < work->n; i++) {
            work->solution[i] += work->corrected[i];
            work->remaining[i] -= step->length * step->product[i];
        }
        OST_TRY(find_norm(work, work->corrected, &moved));
        OST_TRY(find_norm(work, work->solution, error));
        indefinite = step->energy == 0.0 && moved > 0.0;
    }
    work->failed = indefinite || !(moved <= last_step * *error);
    return OST_SUCCESS;
}

static OstStatus measure(Work *work, double *error)
{
    return work->step ? measure_by_cg(work, error) : measure_once(work, error);
}

/* The larger; NAN if `error` is. */
static double at_least(double error, double other)
{
    return other > error ? other : error;
}

static int more_samples(const OstSamples *samples)
{
    if (samples->count > 0 && ost_samples_size(samples) <= small_error)
        return 0;
    return ost_samples_undecided(samples, ost_least_digit, FEWEST_SAMPLES, MOST_SAMPLES);
}

/* Estimates the errors by the residual and by rounding apart. The smallest eigenvalue divides only the first: of the
 * many modes of a random sample few are those of that eigenvalue. */
static OstStatus measure_apart(Work *work, OstEnergyError *error)
{
    double one;
    OstSamples samples = {0, 0.0};
    memcpy(work->vector, work->residual, work->n * sizeof(double));
    OST_TRY(measure(work, &error->energy));
    error->hidden = work->step_size > hidden_beyond * work->smallest * error->energy;
    error->whole = at_least(error->energy, work->step_size / work->smallest);
    while (!work->failed && more_samples(&samples)) {
        ost_rounded_stiffness_force(work->system->matrix, work->u, 1 + samples.count, work->vector);
        OST_TRY(measure(work, &one));
        ost_samples_add(&samples, at_least(one, work->step_size));
    }
    if (work->failed)
        return OST_SUCCESS;
    error->rounding = ost_samples_size(&samples);
    error->spread = ost_samples_spread(&samples);
    error->whole = hypot(error->whole, error->rounding);
    error->energy = hypot(error->energy, error->rounding);
    return OST_SUCCESS;
}

static OstStatus prepare_cg(Work *work)
{
    OstContext *ctx = work->system->matrix->ctx;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &work->remaining, 2 * work->n)));
    work->solution = work->remaining + work->n;
    return ost_compensated_step_create(work->system->matrix, &work->step);
}

static OstStatus estimate(Work *work, const double *f, int compensated, OstEnergyError *error)
{
    const OstEnergyError unknown = {.whole = INFINITY, .energy = INFINITY, .rounding = INFINITY};
    double energy;
    OST_TRY(ost_residual(work->system->matrix, f, work->u, compensated, work->residual));
    OST_TRY(ost_vector_dot(work->system->matrix->ctx, work->n, f, work->u, &energy));
    *error = unknown;
    work->energy_norm = energy > 0.0 ? sqrt(energy) * sqrt(work->smallest) : 0.0;
    if (!(work->energy_norm > 0.0))
        return OST_SUCCESS;
    OST_TRY(find_displacement(work));
    error->rounding = 0.0;
    ost_rounded_stiffness_force(work->system->matrix, work->u, 0, work->vector);
    for (size_t i = 0; i < work->n; i++)
        work->vector[i] += work->residual[i];
    if (compensated && work->preconditioner->factors)
        OST_TRY(prepare_cg(work));
    OST_TRY(measure(work, &error->energy));
    error->whole = at_least(error->energy, work->step_size / work->smallest);
    if (error->whole > small_error && !work->failed)
        OST_TRY(measure_apart(work, error));
    if (work->failed)
        *error = unknown;
    return OST_SUCCESS;
}

OstStatus ost_energy_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                           const double *f, const double *u, int compensated, OstEnergyError *error)
{
    const OstBlockMatrix *matrix = system->matrix;
    OstContext *ctx = matrix->ctx;
    Work work = {
        .system = system, .preconditioner = preconditioner, .n = 3 * (size_t)matrix->rows, .smallest = smallest};
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &work.residual, 3 * (work.n + (size_t)matrix->columns))));
    work.vector = work.residual + work.n;
    work.corrected = work.vector + work.n;
    work.u = work.corrected + work.n;
    memcpy(work.u, u, work.n * sizeof *u);
    const OstStatus status = estimate(&work, f, compensated, error);
    OST_FREE(work.residual, work.remaining);
    ost_compensated_step_destroy(&work.step);
    return status;
}

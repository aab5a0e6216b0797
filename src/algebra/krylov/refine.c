/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/refine.h"

#include "algebra/matrix/compensated_residual.h"
#include "algebra/matrix/compensated_step.h"
#include "algebra/matrix/term_rounding.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Solving again for the recomputed residual must gain this much, or it stalls; so often in a row it may, and where
 * factors are led, whose steps may grow until the modes that they miss are found, and move u yet. */
static const double least_gain = 0.5;
enum { MOST_STALLS = 3, MOST_FACTOR_STALLS = 12 };

/* The limit is an estimate for terms rounded at random: a residual this many times above it may still be rounding's. */
static const double rounding_slack = 3.0;

/* Below so many times the limit the rounding of a product would hide what can still be gained. */
static const double compensated_below = 10.0;

typedef struct Refinement {
    const OstBlockMatrix *matrix;
    const double *f;
    double *u;
    size_t n;           /* unknowns this rank owns */
    double *residual;   /* f - A u */
    double *correction; /* of u */
    double *candidate;  /* u + correction; 3 × columns */
    double *left;       /* the residual of that */
    int taken;          /* was the correction? */
    double contraction; /* of corrections, from the last one taken to the next */
    double moved;       /* largest number of the correction over that of u + correction; where goal->settled asks */
    double least_moved; /* of all corrections */
    int contracts;      /* did the last one lower that by least_gain? Noise would, against the one before */
    OstCompensatedStep *step; /* of factors' corrections, once residuals are computed with compensated sums */
    OstGoal *goal;
} Refinement;

static void say_iterations(OstGoal *goal)
{
    goal->end = OST_END_ITERATIONS;
    snprintf(goal->words, sizeof goal->words, "after %d iterations, the most allowed", goal->iterations);
}

int ost_goal_count(OstGoal *goal, double norm, double weight)
{
    const double whole = log(goal->start / goal->target);
    goal->iterations++;
    ost_convergence_add(&goal->pace, norm, weight);
    ost_progress(goal->ctx, "solve", whole > 0.0 ? fmin(fmax(log(goal->start / norm) / whole, 0.0), 1.0) : 1.0);
    if (norm <= goal->target)
        return 0;
    const double remaining = ost_convergence_remaining(&goal->pace, goal->target);
    if (goal->iterations >= goal->most_iterations) {
        say_iterations(goal);
    } else if (goal->patience > 0 && remaining > goal->patience) {
        goal->end = OST_END_SLOW;
        snprintf(goal->words, sizeof goal->words,
                 "after %d iterations the residual fell by no more than %.4f a step: too slow", goal->pace.count,
                 ost_convergence_factor(&goal->pace));
    }
    return goal->end == OST_END_REACHED;
}

static const char *what_is_wrong(double value)
{
    return !isfinite(value) ? "is not finite" : value < 0.0 ? "is negative" : "is zero";
}

int ost_goal_accepts(OstGoal *goal, double weight)
{
    if (weight > 0.0 && isfinite(weight))
        return 1;
    goal->end = OST_END_PRECONDITIONER;
    snprintf(goal->words, sizeof goal->words,
             "in iteration %d r·z = %g %s: the preconditioner is not positive definite", goal->iterations + 1, weight,
             what_is_wrong(weight));
    return 0;
}

OstStatus ost_goal_refuse_indefinite(const OstGoal *goal, double energy)
{
    return OST_RAISE(goal->ctx, OST_NOT_CONVERGED,
                     "iteration %d: p·Ap = %g %s: the stiffness is not positive definite; check supports and materials",
                     goal->iterations + 1, energy, what_is_wrong(energy));
}

OstStatus ost_goal_set(const OstBlockMatrix *matrix, const double *f, const OstSolverOptions *options, OstGoal *goal)
{
    OstContext *ctx = matrix->ctx;
    const size_t n = 3 * (size_t)matrix->rows;
    double square = ost_dot(n, f, f);
    memset(goal, 0, sizeof *goal);
    goal->ctx = ctx;
    goal->most_iterations = options->max_iterations;
    goal->attainable_will_do = options->accept_attainable;
    OST_TRY(ost_sum(ctx, 1, &square));
    goal->start = goal->norm = sqrt(square);
    goal->target = options->relative_residual * goal->start;
    ost_convergence_start(&goal->pace, goal->start);
    if (!isfinite(goal->start))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the right-hand side holds a number that is not finite");
    return OST_SUCCESS;
}

/* What a candidate is judged by. */
enum { SQUARE, ENERGY, SUMS };

/* left = f - A candidate, and what it says: its square, and twice the energy that the correction takes away. */
static OstStatus examine(Refinement *work, double sums[SUMS])
{
    if (work->goal->compensated) {
        OST_TRY(ost_compensated_residual(work->matrix, work->f, work->candidate, work->left));
    } else {
        OST_TRY(ost_block_matrix_apply(work->matrix, work->candidate, work->left));
        for (size_t i = 0; i < work->n; i++)
            work->left[i] = work->f[i] - work->left[i];
    }
    sums[SQUARE] = ost_dot(work->n, work->left, work->left);
    sums[ENERGY] = ost_dot(work->n, work->correction, work->residual) + ost_dot(work->n, work->correction, work->left);
    return ost_sum(work->matrix->ctx, SUMS, sums);
}

static OstStatus first_residual(Refinement *work)
{
    double sums[SUMS];
    memcpy(work->candidate, work->u, work->n * sizeof(double));
    OST_TRY(examine(work, sums));
    memcpy(work->residual, work->left, work->n * sizeof(double));
    work->goal->norm = sqrt(sums[SQUARE]);
    return OST_SUCCESS;
}

/* How much the correction moves, and by the sum of a geometric series all that would follow. */
static OstStatus find_moved(Refinement *work)
{
    double largest[2] = {0.0}; /* no squares: numbers may be of any unit */
    for (size_t i = 0; i < work->n; i++) {
        largest[0] = fmax(largest[0], fabs(work->correction[i]));
        largest[1] = fmax(largest[1], fabs(work->candidate[i]));
    }
    OST_TRY(OST_MPI(work->matrix->ctx,
                    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, ost_comm(work->matrix->ctx))));
    const double before = work->moved;
    work->moved = largest[1] > 0.0 ? largest[0] / largest[1] : 0.0;
    if (work->taken)
        work->contraction = work->moved / before;
    work->contracts = work->moved < least_gain * work->least_moved;
    work->least_moved = fmin(work->least_moved, work->moved);
    const int stands = work->moved <= work->goal->settled;
    const double series = work->contraction < 1.0 ? work->moved / (1.0 - work->contraction) : HUGE_VAL;
    work->goal->drift = stands ? work->moved : series;
    return OST_SUCCESS;
}

/* u + correction, if that is better. Where u's own rounding is all that residuals show, they are computed with
 * compensated sums, and corrections that contract tell it (Demmel et al., Error bounds from extra-precise iterative
 * refinement, ACM Trans. Math. Softw. 32, 2006). */
static OstStatus take_correction(Refinement *work)
{
    double sums[SUMS];
    for (size_t i = 0; i < work->n; i++)
        work->candidate[i] = work->u[i] + work->correction[i];
    if (work->goal->settled > 0.0)
        OST_TRY(find_moved(work));
    OST_TRY(examine(work, sums));
    const double norm = sqrt(sums[SQUARE]);
    const int contracts = work->step && work->contracts;
    work->taken = isfinite(norm) && (norm < work->goal->norm || sums[ENERGY] > 0.0 || contracts);
    if (!work->taken)
        return OST_SUCCESS;
    memcpy(work->u, work->candidate, work->n * sizeof(double));
    memcpy(work->residual, work->left, work->n * sizeof(double));
    work->goal->norm = norm;
    return OST_SUCCESS;
}

/* About how small ||f - A u|| can be in double precision, each term of A u being rounded at random. */
static OstStatus find_limit(Refinement *work)
{
    const OstBlockMatrix *matrix = work->matrix;
    memcpy(work->candidate, work->u, work->n * sizeof(double));
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), work->candidate));
    ost_term_rounding(matrix, work->candidate, work->left);
    double square = ost_dot(work->n, work->left, work->left);
    OST_TRY(ost_sum(matrix->ctx, 1, &square));
    work->goal->limit = sqrt(square);
    return OST_SUCCESS;
}

/* A body may hardly resist what is wrong with u: then the residual is small long before u stands still. */
static int is_done(const Refinement *work)
{
    const OstGoal *goal = work->goal;
    return goal->norm <= goal->target && !(goal->settled > 0.0 && work->moved > goal->settled);
}

/* The goal is missed yet, or a second correction has not let u stand: where rounding is near, residuals are worth more
 * care from here on. It is near where factors leave more of a residual than no displacement at all would. */
static OstStatus look_for_rounding(Refinement *work)
{
    OstGoal *goal = work->goal;
    const int missed = goal->norm > goal->target || (work->contraction > 0.0 && !is_done(work));
    if (goal->compensated || !missed)
        return OST_SUCCESS;
    OST_TRY(find_limit(work));
    goal->compensated =
        goal->norm <= compensated_below * goal->limit || (goal->settled > 0.0 && goal->norm > goal->start);
    return goal->compensated ? first_residual(work) : OST_SUCCESS;
}

double ost_goal_attainable(const OstGoal *goal)
{
    return fmin(goal->norm, goal->limit) / goal->start;
}

/* The goal was missed: is it rounding? */
static OstStatus judge(Refinement *work)
{
    OstGoal *goal = work->goal;
    OST_TRY(find_limit(work));
    if (goal->norm <= rounding_slack * goal->limit) {
        goal->end = OST_END_ROUNDING;
        snprintf(goal->words, sizeof goal->words,
                 "rounding in double precision allows about %.2g here: ask for no less, or look for what makes the "
                 "stiffness so uneven",
                 ost_goal_attainable(goal));
    } else if (goal->end == OST_END_REACHED && goal->iterations >= goal->most_iterations) {
        say_iterations(goal);
    } else if (goal->end == OST_END_REACHED) {
        goal->end = OST_END_STALLED;
        snprintf(goal->words, sizeof goal->words, "after %d iterations nothing more is gained", goal->pace.count);
    }
    return OST_SUCCESS;
}

/* What `inner` makes of the residual; where factors make it, and rounding is near, as conjugate gradients have it. */
static OstStatus find_correction(Refinement *work, OstInnerSolve inner, void *data)
{
    OstGoal *goal = work->goal;
    memset(work->correction, 0, work->n * sizeof(double));
    OST_TRY(inner(data, work->residual, work->correction, goal));
    if (!goal->compensated || goal->settled == 0.0)
        return OST_SUCCESS;
    if (!work->step)
        OST_TRY(ost_compensated_step_create(work->matrix, &work->step));
    return ost_compensated_step_turn(work->step, work->residual, work->correction);
}

/* Led steps are not at their end while they move u by more than the relative residual asked for, or leave a residual
 * that is more than rounding's: it comes and goes with the modes that factors miss. */
static int most_stalls(const Refinement *work)
{
    const OstGoal *goal = work->goal;
    const int moves = work->moved > goal->target / goal->start;
    return work->step && (moves || goal->norm > rounding_slack * goal->limit) ? MOST_FACTOR_STALLS : MOST_STALLS;
}

static OstStatus refine(Refinement *work, OstInnerSolve inner, void *data)
{
    OstGoal *goal = work->goal;
    OST_TRY(first_residual(work));
    ost_convergence_start(&goal->pace, goal->norm);
    int stalls = 0;
    work->moved = work->least_moved = HUGE_VAL;
    double least_norm = goal->norm;
    do {
        const OstStatus status = find_correction(work, inner, data);
        OST_TRY(take_correction(work));
        OST_TRY(status);
        OST_TRY(look_for_rounding(work));
        const int gained = work->contracts || (goal->norm > goal->target && goal->norm < least_gain * least_norm);
        least_norm = fmin(least_norm, goal->norm);
        stalls = gained ? 0 : stalls + 1;
    } while (goal->end == OST_END_REACHED && !is_done(work) && stalls < most_stalls(work));
    if (goal->norm > goal->target)
        return judge(work);
    goal->end = OST_END_REACHED;
    return OST_SUCCESS;
}

static OstStatus prepare(Refinement *work)
{
    OstContext *ctx = work->matrix->ctx;
    OST_TRY(OST_NEW(ctx, &work->residual, work->n));
    OST_TRY(OST_NEW(ctx, &work->correction, work->n));
    OST_TRY(OST_NEW(ctx, &work->left, work->n));
    return OST_NEW(ctx, &work->candidate, 3 * (size_t)work->matrix->columns);
}

OstStatus ost_refine(const OstBlockMatrix *matrix, OstInnerSolve inner, void *data, const double *f, double *u,
                     OstGoal *goal)
{
    OstContext *ctx = matrix->ctx;
    Refinement work = {.matrix = matrix, .f = f, .u = u, .n = 3 * (size_t)matrix->rows, .goal = goal};
    goal->end = OST_END_REACHED;
    if (goal->start == 0.0) {
        memset(u, 0, work.n * sizeof *u);
        return OST_SUCCESS;
    }
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, prepare(&work)));
    OST_TRY_DONE(refine(&work, inner, data));
done:
    ost_progress(ctx, "solve", -1.0);
    ost_compensated_step_destroy(&work.step);
    OST_FREE(work.residual);
    OST_FREE(work.correction);
    OST_FREE(work.left);
    OST_FREE(work.candidate);
    return status;
}

OstStatus ost_goal_verdict(const OstGoal *goal)
{
    if (goal->end == OST_END_REACHED || (goal->end == OST_END_ROUNDING && goal->attainable_will_do))
        return OST_SUCCESS;
    const double reached = goal->norm / goal->start;
    const double requested = goal->target / goal->start;
    if (goal->end == OST_END_ROUNDING)
        return OST_RAISE(goal->ctx, OST_NOT_CONVERGED,
                         "after %d iterations the relative residual stays at %.3g, not the requested %.3g; %s",
                         goal->iterations, reached, requested, goal->words);
    return OST_RAISE(goal->ctx, OST_NOT_CONVERGED, "%s; the relative residual is %.3g, not the requested %.3g",
                     goal->words, reached, requested);
}

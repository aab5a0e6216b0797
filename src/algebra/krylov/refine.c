/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/refine.h"

#include "algebra/matrix/compensated_step.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

/* A pass that does not halve the residual is a stall. So many are allowed in a row; more for CG preconditioned by
 * factors, which gains late: once it has found the modes that the factors miss. */
static const double least_gain = 0.5;
enum { MOST_STALLS = 3, MOST_FACTOR_STALLS = 12 };

/* Below this many times the limit, rounding of the product A u hides further gains. */
static const double compensated_below = 10.0;

typedef struct Refinement {
    const OstBlockMatrix *matrix;
    const double *f;
    double *u;
    size_t n;           /* unknowns this rank owns */
    double *residual;   /* f - A u */
    double *correction; /* of u */
    double *candidate;  /* u + correction; 3 × columns */
    double *candidate_residual;
    int taken;                /* was the last correction taken? */
    double change;            /* largest component of the correction over that of u + correction; if goal->settled */
    double least_change;      /* of all corrections */
    double contraction;       /* change over the one before */
    int contracts;            /* did the last correction halve least_change? (Noise may halve the one before.) */
    OstCompensatedStep *step; /* turns the factors' corrections into CG steps, once residuals are compensated */
    OstGoal *goal;
} Refinement;

/* What a candidate is judged by. */
enum { SQUARE, ENERGY, SUMS };

/* The residual of the candidate, its square, and twice the energy by which the correction lowers that of u. */
static OstStatus examine_candidate(Refinement *work, double sums[SUMS])
{
    double *left = work->candidate_residual;
    OST_TRY(ost_residual(work->matrix, work->f, work->candidate, work->goal->compensated, left));
    sums[SQUARE] = ost_dot(work->n, left, left);
    sums[ENERGY] = ost_dot(work->n, work->correction, work->residual) + ost_dot(work->n, work->correction, left);
    return ost_sum(work->matrix->ctx, SUMS, sums);
}

static OstStatus recompute_residual(Refinement *work)
{
    double sums[SUMS];
    memcpy(work->candidate, work->u, work->n * sizeof(double));
    OST_TRY(examine_candidate(work, sums));
    memcpy(work->residual, work->candidate_residual, work->n * sizeof(double));
    work->goal->norm = sqrt(sums[SQUARE]);
    return OST_SUCCESS;
}

/* That of u = 0 is f, which takes no product. */
static OstStatus find_first_residual(Refinement *work)
{
    int moves = 0;
    for (size_t i = 0; i < work->n && !moves; i++)
        moves = work->u[i] != 0.0;
    OST_TRY(ost_max_ints(work->matrix->ctx, 1, &moves));
    if (moves)
        return recompute_residual(work);
    memcpy(work->residual, work->f, work->n * sizeof(double));
    work->goal->norm = work->goal->start;
    return OST_SUCCESS;
}

/* How much u may still change, by the geometric series of the corrections. One that is small enough for u to count as
 * settled says nothing of itself, only the later ones do: a strategy that takes over may begin with it. */
static double find_drift(const Refinement *work)
{
    const double series = work->contraction < 1.0 ? work->change / (1.0 - work->contraction) : HUGE_VAL;
    if (work->change > work->goal->settled)
        return series;
    return work->taken ? fmin(work->change, work->contraction * series) : work->change;
}

/* How much the correction changes u, and how that compares with the one before. */
static OstStatus measure_change(Refinement *work)
{
    double largest[2] = {0.0}; /* not 2-norms: squares may overflow, as numbers have any unit */
    for (size_t i = 0; i < work->n; i++) {
        largest[0] = fmax(largest[0], fabs(work->correction[i]));
        largest[1] = fmax(largest[1], fabs(work->candidate[i]));
    }
    OST_TRY(OST_MPI(work->matrix->ctx,
                    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, ost_comm(work->matrix->ctx))));
    const double before = work->change;
    work->change = largest[1] > 0.0 ? largest[0] / largest[1] : 0.0;
    if (work->taken)
        work->contraction = work->change / before;
    work->contracts = work->change < least_gain * work->least_change;
    work->least_change = fmin(work->least_change, work->change);
    return OST_SUCCESS;
}

/* u += correction, if that is better. With compensated residuals, corrections that contract are taken even where the
 * residual, all rounding of u itself, no longer falls (Demmel et al., Error bounds from extra-precise iterative
 * refinement, ACM Trans. Math. Softw. 32, 2006). */
static OstStatus take_correction(Refinement *work)
{
    double sums[SUMS];
    for (size_t i = 0; i < work->n; i++)
        work->candidate[i] = work->u[i] + work->correction[i];
    if (work->goal->settled > 0.0)
        OST_TRY(measure_change(work));
    OST_TRY(examine_candidate(work, sums));
    const double norm = sqrt(sums[SQUARE]);
    const int contracts = work->step && work->contracts;
    work->taken = isfinite(norm) && (norm < work->goal->norm || sums[ENERGY] > 0.0 || contracts);
    if (work->goal->settled > 0.0)
        work->goal->drift = find_drift(work);
    if (!work->taken)
        return OST_SUCCESS;
    memcpy(work->u, work->candidate, work->n * sizeof(double));
    memcpy(work->residual, work->candidate_residual, work->n * sizeof(double));
    work->goal->norm = norm;
    return OST_SUCCESS;
}

/* Estimates how small ||f - A u|| can be in double precision, each term of A u being rounded at random. */
static OstStatus find_limit(Refinement *work)
{
    const OstBlockMatrix *matrix = work->matrix;
    double *rounding = work->candidate_residual, square;
    memcpy(work->candidate, work->u, work->n * sizeof(double));
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), work->candidate));
    ost_term_rounding(matrix, work->candidate, rounding);
    OST_TRY(ost_vector_dot(matrix->ctx, work->n, rounding, rounding, &square));
    work->goal->limit = sqrt(square);
    return OST_SUCCESS;
}

/* Where the stiffness hardly resists the error, the residual is small long before u has settled. */
static int is_done(const Refinement *work)
{
    const OstGoal *goal = work->goal;
    return goal->enough || (goal->norm <= goal->target && !(goal->settled > 0.0 && work->change > goal->settled));
}

/* Switches to compensated residuals where the goal is missed, or u not settled after two corrections, because of
 * rounding: the residual is close to the limit, or the factors leave none smaller than u = 0 does. */
static OstStatus look_for_rounding(Refinement *work)
{
    OstGoal *goal = work->goal;
    const int missed = goal->norm > goal->target || (work->contraction > 0.0 && !is_done(work));
    if (goal->compensated || goal->enough || !missed)
        return OST_SUCCESS;
    OST_TRY(find_limit(work));
    goal->compensated =
        goal->norm <= compensated_below * goal->limit || (goal->settled > 0.0 && goal->norm >= goal->start);
    return goal->compensated ? recompute_residual(work) : OST_SUCCESS;
}

/* The goal was missed: finds out why. */
static OstStatus explain_end(Refinement *work)
{
    OstGoal *goal = work->goal;
    OST_TRY(find_limit(work));
    ost_goal_explain_end(goal, goal->compensated ? ": rounding hides the softest motions of the body" : "");
    return OST_SUCCESS;
}

/* Stalls allowed in a row: more for CG preconditioned by factors while it changes u by more than the relative residual
 * requested, or its residual is above rounding. */
static int most_stalls(const Refinement *work)
{
    const OstGoal *goal = work->goal;
    const int changes = work->change > goal->target / goal->start;
    return work->step && (changes || !ost_goal_at_limit(goal)) ? MOST_FACTOR_STALLS : MOST_STALLS;
}

/* The correction by `inner`. Near rounding, a correction by factors is improved by a CG step with compensated products.
 */
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

static OstStatus refine(Refinement *work, OstInnerSolve inner, void *data)
{
    OstGoal *goal = work->goal;
    OST_TRY(find_first_residual(work));
    ost_convergence_start(&goal->convergence, goal->norm);
    int stalls = 0;
    work->change = work->least_change = HUGE_VAL;
    double least_norm = goal->norm;
    do {
        const OstStatus status = find_correction(work, inner, data);
        OST_TRY(take_correction(work)); /* what was reached counts, also on failure */
        OST_TRY(status);
        OST_TRY(look_for_rounding(work));
        const int gained = work->contracts || (goal->norm > goal->target && goal->norm < least_gain * least_norm);
        least_norm = fmin(least_norm, goal->norm);
        stalls = gained ? 0 : stalls + 1;
    } while (goal->end == OST_END_REACHED && !is_done(work) && stalls < most_stalls(work));
    if (goal->norm > goal->target && !goal->enough)
        return explain_end(work);
    goal->end = OST_END_REACHED;
    return OST_SUCCESS;
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
    OST_TRY(ost_agree(ctx, OST_NEW_UNCLEARED(ctx, &work.residual, 3 * (work.n + (size_t)matrix->columns))));
    work.correction = work.residual + work.n;
    work.candidate_residual = work.correction + work.n;
    work.candidate = work.candidate_residual + work.n;
    const OstStatus status = refine(&work, inner, data);
    ost_progress(ctx, "solve", -1.0);
    ost_compensated_step_destroy(&work.step);
    OST_FREE(work.residual);
    return status;
}

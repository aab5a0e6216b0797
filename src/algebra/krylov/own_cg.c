/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/cg_run.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>

/* Our own conjugate gradients, where AztecOO's cannot be. Preconditioned by factors of A itself there are one to three
 * steps, most of them close to rounding: AztecOO's break down where rounding hides p·Ap, although the step by the
 * factors is right. And of tasks that run together (core/together) each iterates in turn: AztecOO finds its vectors by
 * the number of the call that is under way, so that there can be one at a time. */
typedef struct OwnRun {
    OstCgRun *run;
    OstGoal *goal;
    double *direction; /* p */
    double *product;   /* A' p */
    double *corrected; /* z */
    double weight;     /* r·z of the last direction */
    int blind;         /* rounding hides p·Ap: there is no next direction */
} OwnRun;

/* z = M^-1 r, and the next direction p = z + beta p. */
static OstStatus next_direction(OwnRun *work, int first)
{
    const OstCgRun *run = work->run;
    double weight;
    OST_TRY(run->preconditioner->apply(run->preconditioner->data, run->residual, work->corrected));
    OST_TRY(ost_vector_dot(run->ctx, run->n, run->residual, work->corrected, &weight));
    if (!ost_goal_accepts(work->goal, weight))
        return OST_SUCCESS;
    const double beta = first ? 0.0 : weight / work->weight;
    work->weight = weight;
    for (size_t i = 0; i < run->n; i++)
        work->direction[i] = work->corrected[i] + (first ? 0.0 : beta * work->direction[i]);
    return OST_SUCCESS;
}

/* Is p·Ap mere rounding? With compensated residuals the caller finds the step length. */
static OstStatus look_for_rounding(OwnRun *work, double energy)
{
    double scale;
    work->blind = work->run->preconditioner->factors;
    if (work->goal->compensated || !work->blind)
        return OST_SUCCESS;
    OST_TRY(ost_cg_rounding_scale(work->run, &scale));
    work->blind = fabs(energy) <= ost_cg_rounding * scale;
    return OST_SUCCESS;
}

/* The step along p that minimises the energy; all of p where rounding hides p·Ap. */
static OstStatus step(OwnRun *work, double *u, double *alpha)
{
    OstCgRun *run = work->run;
    OST_TRY(ost_cg_multiply(run, work->direction, work->product));
    double sums[2] = {ost_dot(run->n, work->direction, work->product), ost_dot(run->n, work->direction, run->residual)};
    OST_TRY(ost_sum(run->ctx, 2, sums));
    OST_TRY(look_for_rounding(work, sums[0]));
    if (!work->blind && !(sums[0] > 0.0 && isfinite(sums[0])))
        return ost_cg_judge_energy(run, sums[0], work->goal);
    *alpha = work->blind ? 1.0 : sums[1] / sums[0];
    for (size_t i = 0; i < run->n; i++) {
        u[i] += *alpha * work->direction[i];
        run->residual[i] -= *alpha * work->product[i];
    }
    return OST_SUCCESS;
}

static OstStatus find_norm(const OstCgRun *run, double *norm)
{
    double square = ost_cg_square(run, run->residual);
    OST_TRY(ost_sum(run->ctx, 1, &square));
    *norm = run->size * sqrt(square);
    return OST_SUCCESS;
}

static OstStatus iterate(OwnRun *work, double *u)
{
    OstCgRun *run = work->run;
    OstGoal *goal = work->goal;
    double norm;
    OST_TRY(find_norm(run, &norm));
    int on = (norm > goal->target || goal->settled > 0.0) && goal->iterations < goal->most_iterations;
    for (int first = 1; on; first = 0) {
        double alpha = 0.0;
        OST_TRY(next_direction(work, first));
        if (goal->end == OST_END_REACHED)
            OST_TRY(step(work, u, &alpha));
        if (goal->end != OST_END_REACHED)
            return OST_SUCCESS;
        if (run->runs == 0)
            OST_TRY(ost_lanczos_add(&run->lanczos, alpha, work->weight));
        OST_TRY(find_norm(run, &norm));
        on = ost_goal_count(goal, norm, run->size * run->size * work->weight) && !work->blind;
        if (!run->preconditioner->factors)
            OST_TRY(ost_cg_judge_error(run, u, goal));
        on = on && !goal->enough;
    }
    return OST_SUCCESS;
}

OstStatus ost_cg_run_by_own(OstCgRun *run, double *u, OstGoal *goal)
{
    OwnRun work = {.run = run, .goal = goal};
    OST_TRY(ost_agree(run->ctx, OST_NEW_UNCLEARED(run->ctx, &work.direction, 3 * run->n)));
    work.product = work.direction + run->n;
    work.corrected = work.product + run->n;
    const OstStatus status = iterate(&work, u);
    OST_FREE(work.direction);
    return status;
}

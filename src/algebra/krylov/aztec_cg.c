/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/cg_run.h"
#include "algebra/matrix/vector.h"
#include "algebra/trilinos/conjugate_gradients.h"
#include "core/error.h"
#include "core/parallel/reduce.h"

#include <math.h>

/* AztecOO iterates; the goal and the Lanczos estimate need these numbers of each step. */
typedef struct AztecRun {
    OstCgRun *run;
    OstGoal *goal;
    int steps;
    int multiplied;       /* has A p been computed since the last residual? */
    double energy;        /* this rank's part of p·Ap */
    double weight;        /* r·z of this step */
    double weight_before; /* r·z of the step before */
} AztecRun;

static OstStatus multiply(void *data, const double *p, double *y)
{
    AztecRun *aztec = data;
    if (aztec->multiplied) /* after a breakdown AztecOO computes a residual that is not used */
        return OST_SUCCESS;
    OST_TRY(ost_cg_multiply(aztec->run, p, y));
    aztec->energy = ost_dot(aztec->run->n, p, y);
    aztec->multiplied = 1;
    return OST_SUCCESS;
}

/* Counts the step whose residual is r; `norm` is that of the unscaled residual. */
static OstStatus count_step(AztecRun *aztec, const double *r, double *norm)
{
    OstCgRun *run = aztec->run;
    OstGoal *goal = aztec->goal;
    double sums[2] = {ost_cg_square(run, r), aztec->energy};
    OST_TRY(ost_sum(run->ctx, 2, sums));
    *norm = run->size * sqrt(sums[0]);
    if (aztec->steps == 0)
        return OST_SUCCESS;
    if (run->runs == 0)
        ost_lanczos_add(&run->lanczos, aztec->weight / sums[1],
                        aztec->steps > 1 ? aztec->weight / aztec->weight_before : 0.0);
    ost_goal_count(goal, *norm, run->size * run->size * aztec->weight);
    return OST_SUCCESS;
}

/* Called before each step; ends the iteration if the goal says so. */
static OstStatus precondition(void *data, const double *r, double *z, int *stop)
{
    AztecRun *aztec = data;
    OstCgRun *run = aztec->run;
    OstGoal *goal = aztec->goal;
    double norm;
    OST_TRY(count_step(aztec, r, &norm));
    *stop = norm <= goal->target || goal->end != OST_END_REACHED || goal->iterations >= goal->most_iterations;
    if (*stop)
        return OST_SUCCESS;
    OST_TRY(run->preconditioner->apply(run->preconditioner->data, r, z));
    aztec->weight_before = aztec->weight;
    aztec->weight = ost_dot(run->n, r, z);
    OST_TRY(ost_sum(run->ctx, 1, &aztec->weight));
    *stop = !ost_goal_accepts(goal, aztec->weight);
    aztec->steps++;
    aztec->multiplied = 0;
    return OST_SUCCESS;
}

OstStatus ost_cg_run_by_aztec(OstCgRun *run, double *u, OstGoal *goal)
{
    AztecRun aztec = {.run = run, .goal = goal};
    const OstAztecSystem system = {
        .data = &aztec, .unknowns = (OstLocal)run->n, .multiply = multiply, .precondition = precondition};
    OstAztecEnd end;
    OST_TRY(ost_aztec_cg(run->ctx, &system, run->residual, u, goal->most_iterations - goal->iterations + 1, &end));
    if (end != OST_AZTEC_BREAKDOWN)
        return OST_SUCCESS;
    OST_TRY(ost_sum(run->ctx, 1, &aztec.energy));
    return ost_cg_judge_energy(run, aztec.energy, goal);
}

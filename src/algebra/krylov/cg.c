/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/cg.h"

#include "algebra/krylov/cg_run.h"
#include "algebra/krylov/energy_error.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const double ost_cg_rounding = 1e-13; /* several hundred units in the last place */

/* Where the displacement is hidden, each pass reduces the residual by this factor. */
static const double pass_gain = 1e-2;

enum { MOST_PASSES = 8 };

typedef struct Cg {
    OstCgRun run;
    double smallest, largest; /* eigenvalues of M^-1 A, over the Lanczos estimates so far */
    int hidden;               /* OstEnergyError's: more iterations are needed */
} Cg;

double ost_cg_square(const OstCgRun *run, const double *residual)
{
    const OstScaling *scaling = run->system->scaling;
    return scaling ? ost_scaling_residual_square(scaling, residual) : ost_dot(run->n, residual, residual);
}

OstStatus ost_cg_multiply(OstCgRun *run, const double *p, double *y)
{
    const OstScaling *scaling = run->system->scaling;
    if (scaling)
        ost_scaling_from_scaled(scaling, p, run->unscaled);
    else if (run->n > 0)
        memcpy(run->unscaled, p, run->n * sizeof *p);
    OST_TRY(ost_block_matrix_apply(run->system->matrix, run->unscaled, y));
    if (scaling)
        ost_scaling_to_scaled(scaling, y, y);
    return OST_SUCCESS;
}

OstStatus ost_cg_rounding_scale(const OstCgRun *run, double *scale)
{
    const OstBlockMatrix *matrix = run->system->matrix;
    *scale = 0.0;
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const double *block = ost_block_matrix_diagonal(matrix, i), *p = run->unscaled + 3 * (size_t)i;
        *scale += fabs(block[0]) * p[0] * p[0] + fabs(block[4]) * p[1] * p[1] + fabs(block[8]) * p[2] * p[2];
    }
    return ost_sum(run->ctx, 1, scale);
}

OstStatus ost_cg_judge_energy(const OstCgRun *run, double energy, OstGoal *goal)
{
    double scale;
    OST_TRY(ost_cg_rounding_scale(run, &scale));
    if (energy < -ost_cg_rounding * scale)
        return ost_goal_refuse_indefinite(goal, energy);
    goal->end = OST_END_STALLED;
    goal->singular = 1;
    snprintf(goal->words, sizeof goal->words,
             "in iteration %d p·Ap = %g beside p·Dp = %g: the stiffness is singular to rounding, not positive definite",
             goal->iterations + 1, energy, scale);
    return OST_SUCCESS;
}

/* The error after the first run's steps so far. */
static void find_error(const OstCgRun *run, OstGoal *goal)
{
    OstAlgebraicError *error = &goal->error;
    ost_algebraic_error(&run->lanczos, error);
    goal->rate = ost_algebraic_error_rate(&run->lanczos, error);
    error->size *= run->size;
    error->estimate *= run->size;
    error->bound *= run->size;
}

OstStatus ost_cg_judge_error(OstCgRun *run, const double *u, OstGoal *goal)
{
    const OstErrorStop *stop = goal->stop;
    double *reached = run->unscaled;
    if (!stop || run->runs > 0)
        return OST_SUCCESS;
    find_error(run, goal);
    if (!(goal->error.estimate <= ost_goal_next(goal)))
        return OST_SUCCESS;
    if (run->system->scaling)
        ost_scaling_from_scaled(run->system->scaling, u, reached);
    for (size_t i = 0; i < run->n; i++)
        reached[i] = run->base[i] + run->size * (run->system->scaling ? reached[i] : u[i]);
    OST_TRY(stop->ask(stop->data, reached, goal->error.estimate, &goal->next));
    goal->enough = goal->error.estimate <= goal->next;
    if (!(goal->next > 0.0))
        goal->stop = NULL;
    return OST_SUCCESS;
}

/* OstInnerSolve: solves A' u' = S r; u = S^T u'. */
static OstStatus solve_scaled(void *data, const double *r, double *u, OstGoal *goal)
{
    OstCgRun *run = &((Cg *)data)->run;
    const OstScaling *scaling = run->system->scaling;
    if (scaling)
        ost_scaling_to_scaled(scaling, r, run->residual);
    else
        memcpy(run->residual, r, run->n * sizeof *r);
    OST_TRY(ost_vector_size(run->ctx, run->n, run->residual, &run->size));
    for (size_t i = 0; i < run->n; i++)
        run->residual[i] /= run->size;
    ost_goal_begin_pass(goal);
    const int by_own = run->preconditioner->factors || ost_together_any(run->ctx);
    const OstStatus status = by_own ? ost_cg_run_by_own(run, u, goal) : ost_cg_run_by_aztec(run, u, goal);
    for (size_t i = 0; i < run->n; i++)
        u[i] *= run->size;
    if (scaling)
        ost_scaling_from_scaled(scaling, u, u);
    run->runs++;
    return status;
}

/* Estimates the spectrum of M^-1 A and the error of u, which stays 0 (unknown) where M is not positive definite. */
static OstStatus report_error(Cg *cg, const double *f, const double *u, OstGoal *goal, OstSolveReport *report)
{
    OstEnergyError error = {.whole = NAN};
    double smallest, largest;
    ost_lanczos_extremes(&cg->run.lanczos, &smallest, &largest);
    cg->smallest = cg->smallest > 0.0 && smallest > 0.0 ? fmin(cg->smallest, smallest) : fmax(cg->smallest, smallest);
    cg->largest = fmax(cg->largest, largest);
    goal->smallest = cg->smallest;
    goal->error = (OstAlgebraicError){0};
    if (cg->run.runs == 1 && cg->run.lanczos.count > 1 && !cg->run.preconditioner->factors)
        find_error(&cg->run, goal);
    cg->run.lanczos.count = 0;
    cg->run.runs = 0;
    if (cg->smallest > 0.0 && goal->end != OST_END_PRECONDITIONER && !goal->crude && !goal->enough)
        OST_TRY(
            ost_energy_error(cg->run.system, cg->run.preconditioner, cg->smallest, f, u, goal->compensated, &error));
    if (goal->enough) /* rounding is far below that, or ost_solver_error will tell */
        error = (OstEnergyError){.whole = goal->error.estimate / goal->error.size,
                                 .energy = goal->error.estimate / goal->error.size};
    report->condition_estimate = cg->smallest > 0.0 ? cg->largest / cg->smallest : 0.0;
    const int known = !isnan(error.whole) && !isnan(error.rounding);
    /* If corrections by factors do not settle, rounding of the factors is the cause: the drift is its error. */
    report->error_estimate = known ? fmax(error.whole, goal->drift) : 0.0;
    report->energy_error = known ? fmax(error.energy, goal->drift) : 0.0;
    report->rounding_error = known ? fmax(error.rounding, goal->drift) : 0.0;
    report->rounding_spread = known && error.rounding >= goal->drift ? error.spread : 0.0;
    cg->hidden = known && error.hidden;
    return OST_SUCCESS;
}

/* One pass towards a residual that is pass_gain times smaller. If it misses the goal, u stays as it was. *on: may
 * another pass gain more? */
static OstStatus tighten(Cg *cg, const double *f, double *u, double *before, OstGoal *goal, int *on)
{
    OstGoal tighter = *goal;
    tighter.target = pass_gain * goal->norm;
    memcpy(before, u, cg->run.n * sizeof *u);
    OST_TRY(ost_refine(cg->run.system->matrix, solve_scaled, cg, f, u, &tighter));
    *on = tighter.end == OST_END_REACHED;
    goal->iterations = tighter.iterations;
    if (tighter.norm > goal->target) {
        memcpy(u, before, cg->run.n * sizeof *u);
        *on = 0;
        return OST_SUCCESS;
    }
    goal->norm = tighter.norm;
    goal->compensated = tighter.compensated;
    return OST_SUCCESS;
}

/* The residual is small only because one stiff region dominates it: a soft region has not converged, and its
 * eigenvalues have not been seen. Tightens the target until the error estimate is below the residual requested. */
static OstStatus solve_hidden(Cg *cg, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    double *before = NULL;
    OST_TRY(ost_agree(cg->run.ctx, OST_NEW(cg->run.ctx, &before, cg->run.n)));
    OstStatus status = OST_SUCCESS;
    const double requested = goal->target / goal->start;
    for (int pass = 0, on = 1; pass < MOST_PASSES && on && cg->hidden && status == OST_SUCCESS; pass++) {
        if (report->error_estimate <= requested)
            break;
        status = tighten(cg, f, u, before, goal, &on);
        OST_THEN(report_error(cg, f, u, goal, report));
    }
    OST_FREE(before);
    return status;
}

OstStatus ost_cg_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *f, double *u,
                       OstGoal *goal, OstSolveReport *report)
{
    OstContext *ctx = system->matrix->ctx;
    Cg cg = {.run = {.ctx = ctx,
                     .system = system,
                     .preconditioner = preconditioner,
                     .n = 3 * (size_t)system->matrix->rows,
                     .base = u}};
    OstStatus status = OST_NEW(ctx, &cg.run.residual, cg.run.n + 3 * (size_t)system->matrix->columns);
    OST_THEN(ost_lanczos_create(ctx, goal->most_iterations, &cg.run.lanczos));
    OST_TRY_DONE(ost_agree(ctx, status));
    cg.run.unscaled = cg.run.residual + cg.run.n;
    OST_TRY_DONE(ost_refine(system->matrix, solve_scaled, &cg, f, u, goal));
    OST_TRY_DONE(report_error(&cg, f, u, goal, report));
    if (cg.hidden && goal->end == OST_END_REACHED)
        OST_TRY_DONE(solve_hidden(&cg, f, u, goal, report));
done:
    OST_FREE(cg.run.residual);
    ost_lanczos_destroy(&cg.run.lanczos);
    return status;
}

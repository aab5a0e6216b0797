/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/superposition.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "solve/linear.h"
#include "solve/newton.h"

#include <math.h>
#include <string.h>

void ost_superposition_release(OstSuperposition *all)
{
    for (int k = 0; k < all->count; k++)
        OST_FREE(all->part[k]);
    OST_FREE(all->part);
    OST_FREE(all->norm);
    all->count = 0;
}

OstStatus ost_superposition_make_room(const OstProblem *problem, OstSuperposition *all)
{
    OstContext *ctx = problem->ctx;
    const int functions = ost_problem_functions(problem);
    *all = (OstSuperposition){0};
    ost_ledger_enter(ctx, OST_EFFECT_PATH);
    OstStatus status = OST_NEW(ctx, &all->part, functions);
    OST_THEN(OST_NEW(ctx, &all->norm, functions));
    for (int k = 0; k < functions && status == OST_SUCCESS; k++) {
        status = OST_NEW(ctx, &all->part[k], ost_newton_state_size(problem));
        all->count = k + 1;
    }
    ost_ledger_leave(ctx);
    return ost_agree(ctx, status);
}

/* The reports of several solves as one. */
static void add_report(OstSolveReport *all, const OstSolveReport *one)
{
    const OstSolveReport before = *all;
    *all = *one;
    all->iterations += before.iterations;
    all->solve_seconds += before.solve_seconds;
    all->relative_residual = fmax(before.relative_residual, one->relative_residual);
    all->attainable_residual = fmax(before.attainable_residual, one->attainable_residual);
    all->rounding_limited |= before.rounding_limited;
    all->condition_estimate = fmax(before.condition_estimate, one->condition_estimate);
    all->error_estimate = fmax(before.error_estimate, one->error_estimate);
    all->energy_error = fmax(before.energy_error, one->energy_error);
    if (before.rounding_error > one->rounding_error) {
        all->rounding_error = before.rounding_error;
        all->rounding_spread = before.rounding_spread;
    }
}

/* What is left of a solve that stopped early is an answer too, if not a good one. */
static OstStatus solve_function(OstAnalysis *analysis, int function, OstSuperposition *all, int *unfinished)
{
    OstVerdict before = {.count = 0};
    OstSolveReport report;
    OST_TRY(ost_linear_load(analysis, function, &before));
    OST_TRY(ost_verdict_raise(analysis->ctx, &before));
    const OstStatus solved = ost_linear_solve(analysis, function, &report, &all->norm[function], all->part[function]);
    add_report(&all->solve, &report);
    *unfinished |= solved == OST_NOT_CONVERGED;
    return solved == OST_NOT_CONVERGED ? OST_SUCCESS : solved;
}

OstStatus ost_superposition_create(OstAnalysis *analysis, OstSuperposition *all)
{
    int unfinished = 0;
    OstStatus status = ost_superposition_make_room(analysis->problem, all);
    for (int k = 0; k < all->count && status == OST_SUCCESS; k++)
        status = solve_function(analysis, k, all, &unfinished);
    if (status != OST_SUCCESS)
        ost_superposition_release(all);
    else if (unfinished)
        status = OST_NOT_CONVERGED;
    return status;
}

/* The pressures at t, in the work space of the linear analysis. */
static void add_pressures(const OstSuperposition *all, const OstAnalysis *analysis, double t, OstResult *result)
{
    const OstProblem *problem = analysis->problem;
    double *pressure = ((OstLinear *)analysis->work)->pressure;
    memset(pressure, 0, (size_t)problem->pressures->count * sizeof *pressure);
    for (int k = 0; k < all->count; k++) {
        const double *part = all->part[k] + 3 * (size_t)problem->mesh->node_count;
        for (OstLocal i = 0; i < problem->pressures->count; i++)
            pressure[i] += ost_problem_factor(problem, k, t) * part[i];
    }
    ost_pressure_of_tets(problem->pressures, pressure, result->pressure);
}

OstStatus ost_superposition_at(const OstSuperposition *all, const OstAnalysis *analysis, double t, OstResult *result,
                               OstSolvedFor *solved_for)
{
    const OstProblem *problem = analysis->problem;
    const size_t count = 3 * (size_t)problem->mesh->node_count;
    double *u = result->displacement;
    double work = 0.0;
    memset(u, 0, count * sizeof *u);
    *solved_for = (OstSolvedFor){0};
    ost_ledger_enter(problem->ctx, OST_EFFECT_PATH);
    for (int k = 0; k < all->count; k++) {
        const double factor = ost_problem_factor(problem, k, t);
        for (size_t i = 0; i < count; i++)
            u[i] += factor * all->part[k][i];
        solved_for->norm += fabs(factor) * all->norm[k];
    }
    if (problem->pressures)
        add_pressures(all, analysis, t, result);
    const OstStatus status = ost_linear_work(analysis, t, u, &work);
    ost_ledger_leave(problem->ctx);
    solved_for->work = work;
    result->solve = all->solve;
    result->checks.rigid_motion = ((const OstLinear *)analysis->work)->rigid_motion;
    result->reached = 1;
    return status;
}

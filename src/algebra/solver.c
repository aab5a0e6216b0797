/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"

#include "algebra/matrix/compensated_residual.h"
#include "algebra/matrix/vector.h"
#include "algebra/solver_options.h"
#include "algebra/solver_plan.h"
#include "algebra/strategy.h"
#include "algebra/trilinos/epetra.h"
#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>
#include <string.h>

struct OstSolver {
    OstContext *ctx;
    const OstBlockMatrix *matrix;
    OstSolverGeometry geometry;
    OstSolverPlan plan;
    OstStrategy *rung; /* NULL if there are no unknowns */
    OstEpetraMap *map;
    double setup_seconds; /* of all rungs so far */
    double rung_seconds;  /* of the one that stands, until it has been booked to a step */
    int steps;            /* rungs that could not be built before the one that stands */
    OstSolveStep step[OST_MAX_STEPS];
};

static int climbs(const OstSolver *solver)
{
    return solver->plan.options.recipe == OST_RECIPE_AUTO;
}

/* Notes how a rung ended; the last place is kept for the one that reaches the goal. */
static OstSolveStep *note_step(OstSolveStep *step, int *steps, OstRecipe rung, const char *outcome)
{
    OstSolveStep *noted = &step[*steps < OST_MAX_STEPS ? (*steps)++ : OST_MAX_STEPS - 1];
    memset(noted, 0, sizeof *noted);
    noted->rung = rung;
    snprintf(noted->outcome, sizeof noted->outcome, "%s", outcome);
    return noted;
}

/* What another rung may do better: not so a mistake in the input or a failure of MPI. */
static int is_climbable(OstStatus status)
{
    return status == OST_NOT_CONVERGED || status == OST_OUT_OF_MEMORY || status == OST_LIMIT_EXCEEDED;
}

/* Makes `recipe` the rung that stands, or, where it cannot be built and the ladder may climb, one above it. */
static OstStatus stand_on(OstSolver *solver, OstRecipe recipe, OstSolveStep *step, int *steps)
{
    OstSolverOptions options;
    for (;; recipe++) {
        const double start = ost_seconds();
        ost_solver_rung_options(&solver->plan.options, recipe, &options);
        ost_ledger_enter(solver->ctx, OST_LEDGER_HIERARCHY);
        const OstStatus status = ost_strategy_prepare(solver->matrix, &solver->geometry, &options, &solver->rung);
        ost_ledger_leave(solver->ctx);
        solver->rung_seconds = ost_seconds() - start;
        solver->setup_seconds += solver->rung_seconds;
        ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: %s: %s (%.3f s)", ost_recipe_name(recipe),
                status == OST_SUCCESS ? "set up" : ost_error_text(solver->ctx), solver->rung_seconds);
        if (status == OST_SUCCESS || !climbs(solver) || !is_climbable(status))
            return status;
        note_step(step, steps, recipe, ost_error_text(solver->ctx))->seconds = solver->rung_seconds;
        if (recipe == OST_RECIPE_DIRECT)
            return status;
    }
}

/* All that was tried, where that was more than one rung; `status` and its text are those of the last. */
static OstStatus raise_all(OstContext *ctx, const OstSolveStep *step, int steps, OstStatus status)
{
    enum { LONGEST_NAME = 64 }; /* of a rung with its iterations */
    char tried[OST_MAX_STEPS * (OST_LONGEST_OUTCOME + LONGEST_NAME)] = "";
    size_t length = 0;
    char last[OST_ERROR_TEXT_SIZE];
    if (steps < 2 || !is_climbable(status))
        return status;
    snprintf(last, sizeof last, "%s", ost_error_text(ctx));
    for (int s = 0; s < steps && length < sizeof tried; s++)
        length += (size_t)snprintf(tried + length, sizeof tried - length, "%s%s (%d iterations): %s", s ? "; " : "",
                                   ost_recipe_name(step[s].rung), step[s].iterations, step[s].outcome);
    return OST_RAISE(ctx, OST_NOT_CONVERGED, "%s. Tried: %s", last, tried);
}

static OstSolverFacts facts_of(const OstSolver *solver)
{
    OstSolverFacts facts = {0};
    if (solver->geometry.facts)
        facts = *solver->geometry.facts;
    facts.unknowns = 3 * solver->matrix->global_rows;
    return facts;
}

static void tell_plan(const OstSolver *solver)
{
    for (int r = 0; r < solver->plan.reasons; r++)
        ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: %s%s%s", r == 0 ? ost_recipe_name(solver->plan.first) : "",
                r == 0 ? " first: " : "", solver->plan.reason[r]);
}

static OstStatus make_plan(OstSolver *solver, const OstSolverOptions *options)
{
    const OstSolverFacts facts = facts_of(solver);
    ost_solver_plan(options, &facts, &solver->plan);
    tell_plan(solver);
    return ost_epetra_map_create(solver->ctx, 3 * solver->matrix->rows, &solver->map);
}

/* The plan's rule of thumb lets a small body be factored that the analysis then finds not to fit. */
static OstStatus stand_on_first(OstSolver *solver, const OstSolverOptions *options)
{
    const OstStatus status = stand_on(solver, solver->plan.first, solver->step, &solver->steps);
    const int has_no_room = status == OST_OUT_OF_MEMORY || status == OST_LIMIT_EXCEEDED;
    if (!has_no_room || !climbs(solver) || solver->plan.first != OST_RECIPE_DIRECT)
        return status;
    const OstSolverFacts facts = facts_of(solver);
    ost_solver_plan_without_factors(options, &facts, &solver->plan);
    tell_plan(solver);
    return stand_on(solver, solver->plan.first, solver->step, &solver->steps);
}

OstStatus ost_solver_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstSolver **solver)
{
    OstSolver *made = NULL;
    *solver = NULL;
    OstStatus status = ost_solver_check_options(ctx, options);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made, 1);
    OST_TRY_DONE(ost_agree(ctx, status));
    made->ctx = ctx;
    made->matrix = matrix;
    made->geometry = *geometry;
    OST_TRY_DONE(make_plan(made, options));
    if (matrix->global_rows > 0)
        status = stand_on_first(made, options);
    if (status != OST_SUCCESS)
        status = raise_all(ctx, made->step, made->steps, status);
done:
    if (status != OST_SUCCESS)
        ost_solver_destroy(&made);
    *solver = made;
    return status;
}

void ost_solver_destroy(OstSolver **solver)
{
    if (!*solver)
        return;
    ost_strategy_destroy(&(*solver)->rung);
    ost_epetra_map_destroy(&(*solver)->map);
    OST_FREE(*solver);
}

static OstStatus find_residual(const OstBlockMatrix *matrix, const double *f, double *u, int compensated,
                               double *residual)
{
    if (compensated)
        return ost_compensated_residual(matrix, f, u, residual);
    OST_TRY(ost_block_matrix_apply(matrix, u, residual));
    for (size_t i = 0; i < 3 * (size_t)matrix->rows; i++)
        residual[i] = f[i] - residual[i];
    return OST_SUCCESS;
}

/* ||f - A u|| / ||f||, by Epetra's norms: no code in common with what the recipes stop by but the product. */
static OstStatus measure_residual(const OstSolver *solver, const double *f, const double *u, int compensated,
                                  double *relative)
{
    OstContext *ctx = solver->ctx;
    const size_t n = 3 * (size_t)solver->matrix->rows;
    double *vector = NULL;
    double *residual = NULL;
    double norm = 0.0;
    double f_norm = 0.0;
    OstStatus status = OST_NEW(ctx, &vector, 3 * (size_t)solver->matrix->columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &residual, n);
    OST_TRY_DONE(ost_agree(ctx, status));
    memcpy(vector, u, n * sizeof *u);
    OST_TRY_DONE(find_residual(solver->matrix, f, vector, compensated, residual));
    OST_TRY_DONE(ost_epetra_norm(solver->map, residual, &norm));
    OST_TRY_DONE(ost_epetra_norm(solver->map, f, &f_norm));
    *relative = f_norm > 0.0 ? norm / f_norm : norm;
done:
    OST_FREE(vector);
    OST_FREE(residual);
    return status;
}

/* Works on the rung that stands, from the u that there is. */
static OstStatus work(OstSolver *solver, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    const double start = ost_seconds();
    const int before = goal->iterations;
    const OstStatus status = ost_strategy_improve(solver->rung, f, u, goal, report);
    const char *outcome = status != OST_SUCCESS          ? ost_error_text(solver->ctx)
                          : goal->end == OST_END_REACHED ? "reached the residual asked for"
                                                         : goal->words;
    OstSolveStep *step = note_step(report->step, &report->steps, ost_strategy_recipe(solver->rung), outcome);
    step->iterations = goal->iterations - before;
    step->factor = step->iterations > 0 ? ost_convergence_whole_factor(&goal->pace) : 0.0;
    step->relative_residual = goal->start > 0.0 ? goal->norm / goal->start : 0.0;
    step->seconds = ost_seconds() - start + solver->rung_seconds;
    ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: %s: %d iterations in %.3f s to a residual of %.2e: %s",
            ost_recipe_name(step->rung), step->iterations, ost_seconds() - start, step->relative_residual,
            step->outcome);
    solver->rung_seconds = 0.0;
    return status;
}

/* Is there a rung that could do better? */
static int should_climb(const OstSolver *solver, const OstGoal *goal)
{
    const int mendable =
        goal->end == OST_END_SLOW || goal->end == OST_END_PRECONDITIONER || goal->end == OST_END_STALLED;
    return climbs(solver) && mendable && ost_strategy_recipe(solver->rung) < OST_RECIPE_DIRECT;
}

/* The rung that came down fastest, to be gone on with where those above it ask for more memory than there is; AUTO if
 * none did at all. */
static OstRecipe fastest(const OstSolveReport *report)
{
    OstRecipe found = OST_RECIPE_AUTO;
    double least = 0.9999;
    for (int s = 0; s < report->steps; s++)
        if (report->step[s].iterations >= OST_CONVERGENCE_WINDOW && report->step[s].factor < least) {
            found = report->step[s].rung;
            least = report->step[s].factor;
        }
    return found;
}

static OstStatus climb(OstSolver *solver, OstGoal *goal, OstSolveReport *report)
{
    const OstRecipe from = ost_strategy_recipe(solver->rung);
    const OstStatus status = stand_on(solver, (OstRecipe)(from + 1), report->step, &report->steps);
    if (status != OST_OUT_OF_MEMORY && status != OST_LIMIT_EXCEEDED)
        return status;
    const OstRecipe best = fastest(report);
    if (best == OST_RECIPE_AUTO)
        return status;
    goal->patience = 0; /* there is nothing above */
    return stand_on(solver, best, report->step, &report->steps);
}

static OstStatus ascend(OstSolver *solver, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    goal->patience = climbs(solver) ? solver->plan.options.patience : 0;
    OST_TRY(work(solver, f, u, goal, report));
    while (should_climb(solver, goal)) {
        OST_TRY(climb(solver, goal, report));
        OST_TRY(work(solver, f, u, goal, report));
    }
    return OST_SUCCESS;
}

static void report_goal(const OstSolver *solver, const OstGoal *goal, OstSolveReport *report)
{
    report->recipe = solver->rung ? ost_strategy_recipe(solver->rung) : solver->plan.first;
    report->iterations = goal->iterations;
    if (goal->start > 0.0) {
        report->relative_residual = goal->norm / goal->start;
        report->attainable_residual = ost_goal_attainable(goal);
        report->rounding_limited = goal->end == OST_END_ROUNDING;
    }
}

/* f and u of order 1 or so, whatever the units. */
static OstStatus solve_scaled(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    OstGoal goal;
    if (!solver->rung && solver->matrix->global_rows > 0)
        return OST_RAISE(solver->ctx, OST_NOT_CONVERGED, "no rung of this solver is left: an earlier solve tried all");
    OST_TRY(ost_goal_set(solver->matrix, f, &solver->plan.options, &goal));
    OstStatus status = OST_SUCCESS;
    if (solver->rung)
        status = ascend(solver, f, u, &goal, report);
    report_goal(solver, &goal, report);
    if (status == OST_SUCCESS)
        status = ost_goal_verdict(&goal);
    if (status != OST_SUCCESS)
        return raise_all(solver->ctx, report->step, report->steps, status);
    return measure_residual(solver, f, u, goal.compensated, &report->relative_residual);
}

static OstStatus solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    const size_t n = 3 * (size_t)solver->matrix->rows;
    double *scaled = NULL;
    double size;
    OST_TRY(ost_vector_size(solver->ctx, n, f, &size));
    OST_TRY(ost_agree(solver->ctx, OST_NEW(solver->ctx, &scaled, n)));
    for (size_t i = 0; i < n; i++) {
        scaled[i] = f[i] / size;
        u[i] = 0.0;
    }
    const OstStatus status = solve_scaled(solver, scaled, u, report);
    for (size_t i = 0; i < n; i++)
        u[i] *= size;
    OST_FREE(scaled);
    return status;
}

OstStatus ost_solver_solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    memset(report, 0, sizeof *report);
    report->plan = solver->plan;
    report->steps = solver->steps;
    memcpy(report->step, solver->step, sizeof solver->step);
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    const double start = ost_seconds();
    const double setup = solver->setup_seconds;
    const OstStatus status = solve(solver, f, u, report);
    report->setup_seconds = solver->setup_seconds;
    report->solve_seconds = ost_seconds() - start - (solver->setup_seconds - setup);
    ost_ledger_leave(solver->ctx);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"

#include "algebra/krylov/cg.h"
#include "algebra/krylov/energy_error.h"
#include "algebra/krylov/precondition.h"
#include "algebra/matrix/vector.h"
#include "algebra/solver_data.h"
#include "algebra/solver_options.h"
#include "algebra/solver_plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"

#include <stdio.h>
#include <string.h>

/* May the solver take another strategy? Not if the user has chosen the method. */
static int may_change(const OstSolver *solver)
{
    return solver->plan.options.method == OST_METHOD_AUTO && !solver->is_shared;
}

/* Records how a strategy ended. If there are too many, the last place is overwritten: the final one is there. */
static OstSolveStep *note_step(OstSolveStep *step, int *steps, OstMethod method, const char *outcome)
{
    OstSolveStep *noted = &step[*steps < OST_MAX_STEPS ? (*steps)++ : OST_MAX_STEPS - 1];
    memset(noted, 0, sizeof *noted);
    noted->method = method;
    snprintf(noted->outcome, sizeof noted->outcome, "%s", outcome);
    return noted;
}

static void destroy_strategy(OstSolver *solver)
{
    ost_smoothed_aggregation_destroy(&solver->plain);
    ost_metric_destroy(&solver->metric);
    ost_direct_destroy(&solver->direct);
    ost_saddle_factors_destroy(&solver->whole);
    solver->method = OST_METHOD_AUTO;
}

/* Sets up the method that `options` names. METRIC's hierarchy is kept for STRONG, unless that does without its linear
 * tets; anything else is destroyed before the new one is built. On failure there is no strategy. */
static OstStatus set_up(OstSolver *solver, const OstSolverOptions *options)
{
    OstStatus status = OST_SUCCESS;
    const int keeps = solver->method == OST_METHOD_METRIC && options->method == OST_METHOD_STRONG;
    if (keeps && !ost_metric_is_over_linear(solver->metric)) {
        ost_metric_strengthen(solver->metric, options);
    } else {
        destroy_strategy(solver);
        OST_TRY(ost_geometry_renew(&solver->geometry));
        if (options->method == OST_METHOD_PLAIN)
            status = ost_smoothed_aggregation_create(solver->matrix, &solver->geometry, options, &solver->plain);
        else if (options->method == OST_METHOD_DIRECT)
            status = ost_solver_factor_direct(solver, options->factor_memory);
        else
            status = ost_metric_create(solver->matrix, &solver->geometry, options, &solver->metric);
    }
    solver->method = status == OST_SUCCESS ? options->method : OST_METHOD_AUTO;
    solver->aged = 0;
    return status;
}

/* Improves u as ost_cg_solve; also fills the report's engine, levels and complexity. */
static OstStatus improve(OstSolver *solver, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    if (solver->saddle)
        return ost_solver_improve_mixed(solver, f, u, goal, report);
    if (solver->metric)
        return ost_metric_improve(solver->metric, f, u, goal, report);
    if (solver->direct)
        return ost_direct_solve(solver->direct, f, u, goal, report);
    OstPreconditioner cycle;
    OstCgSystem system;
    ost_solver_system(solver, &system, &cycle);
    ost_smoothed_aggregation_report(solver->plain, report);
    snprintf(report->engine, sizeof report->engine, "AztecOO CG, ML V-cycle of %d levels of its own", report->levels);
    return ost_cg_solve(&system, &cycle, f, u, goal, report);
}

/* Could another strategy succeed? Not if the input is wrong or MPI fails. */
static int is_mendable(OstStatus status)
{
    return status == OST_NOT_CONVERGED || status == OST_OUT_OF_MEMORY || status == OST_LIMIT_EXCEEDED;
}

/* Builds the strategy for `method`. If that fails and the solver may change it, builds the next one that can be built.
 */
static OstStatus build(OstSolver *solver, OstMethod method, OstSolveStep *step, int *steps)
{
    OstSolverOptions options;
    for (;; method++) {
        const double start = ost_own_seconds(solver->ctx);
        ost_solver_learned_options(solver, method, &options);
        ost_ledger_enter(solver->ctx, OST_LEDGER_HIERARCHY);
        const OstStatus status = ost_solver_explain_memory(solver, &options, set_up(solver, &options));
        ost_ledger_leave(solver->ctx);
        solver->strategy_seconds = ost_own_seconds(solver->ctx) - start;
        solver->setup_seconds += solver->strategy_seconds;
        solver->singular |= status == OST_NOT_CONVERGED;
        ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: %s: %s (%.3f s)", ost_method_name(method),
                status == OST_SUCCESS ? "set up" : ost_error_text(solver->ctx), solver->strategy_seconds);
        if (status == OST_SUCCESS || !may_change(solver) || !is_mendable(status) || solver->aim.probing)
            return status;
        note_step(step, steps, method, ost_error_text(solver->ctx))->seconds = solver->strategy_seconds;
        if (method == OST_METHOD_DIRECT)
            return status;
    }
}

/* A preconditioner that is no good has others beside it, where the case does not fix the method. */
static OstStatus raise_fixed(const OstSolver *solver, OstStatus status)
{
    char last[OST_ERROR_TEXT_SIZE];
    snprintf(last, sizeof last, "%s", ost_error_text(solver->ctx));
    return OST_RAISE(solver->ctx, status, "%s; leave out 'method: %s' and the solver goes on with another one", last,
                     ost_method_name(solver->plan.options.method));
}

/* Raises all that was tried, if that was more than one strategy; `status` and its text are those of the last. */
static OstStatus raise_all(OstContext *ctx, const OstSolveStep *step, int steps, OstStatus status)
{
    enum { LONGEST_NAME = 64 }; /* of a strategy with its iterations */
    char tried[OST_MAX_STEPS * (OST_LONGEST_OUTCOME + LONGEST_NAME)] = "";
    size_t length = 0;
    char last[OST_ERROR_TEXT_SIZE];
    if (steps < 2 || !is_mendable(status))
        return status;
    snprintf(last, sizeof last, "%s", ost_error_text(ctx));
    for (int s = 0; s < steps && length < sizeof tried; s++)
        length += (size_t)snprintf(tried + length, sizeof tried - length, "%s%s (%d iterations): %s", s ? "; " : "",
                                   ost_method_name(step[s].method), step[s].iterations, step[s].outcome);
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

/* Only where the plan depends on it: quadratic tets may be factored, whole or by their vertices. */
static OstStatus measure(const OstSolver *solver, OstSolverFacts *facts)
{
    static const double thin = 14.0; /* nodes across: tets that are longer than the body is thick */
    const int matters = solver->options.method == OST_METHOD_AUTO && solver->geometry.coarse && facts->thickness > 0.0;
    if (!matters || facts->repeated || !(facts->anisotropy > 1.0 || facts->thickness < thin))
        return OST_SUCCESS;
    return ost_metric_measure(solver->matrix, &solver->geometry, facts);
}

static void tell_plan(const OstSolver *solver)
{
    for (int r = 0; r < solver->plan.reasons; r++)
        ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: %s%s%s", r == 0 ? ost_method_name(solver->plan.first) : "",
                r == 0 ? " first: " : "", solver->plan.reason[r]);
}

static OstStatus raise_singular(OstContext *ctx)
{
    return OST_RAISE(ctx, OST_NOT_CONVERGED,
                     "the stiffness is singular to rounding, which leaves the displacement less than one digit; %s",
                     ost_rounding_remedy);
}

/* Memory for a factorisation is no way out then: replaces the words of the step that did not get it. */
static OstStatus refuse_singular(OstContext *ctx, OstSolveStep *step)
{
    snprintf(step->outcome, sizeof step->outcome,
             "does not fit, and would not help: the stiffness is singular to rounding");
    return raise_singular(ctx);
}

/* Builds the first strategy. If the plan chose to factor, but the analysis finds that the factors do not fit into
 * memory, plans again without them. */
static OstStatus build_first(OstSolver *solver, const OstSolverOptions *options)
{
    const OstStatus status = build(solver, solver->plan.first, solver->step, &solver->steps);
    const int has_no_room = status == OST_OUT_OF_MEMORY || status == OST_LIMIT_EXCEEDED;
    if (!has_no_room || !may_change(solver) || solver->plan.first < OST_METHOD_TWO_LEVEL)
        return status;
    const OstSolverFacts facts = facts_of(solver);
    ost_solver_plan_without_factors(options, &facts, &solver->plan);
    tell_plan(solver);
    return build(solver, solver->plan.first, solver->step, &solver->steps);
}

static OstStatus start(OstSolver *solver, const OstSolverOptions *options, int repeated)
{
    OstSolverFacts facts = facts_of(solver);
    solver->repeated = facts.repeated |= repeated;
    solver->factors = (OstMumpsForecast){0.0, 0.0};
    OstStatus status = OST_SUCCESS;
    solver->steps = solver->singular = solver->fine = solver->fits = 0;
    OST_TRY(ost_geometry_renew(&solver->geometry));
    OST_TRY(measure(solver, &facts));
    ost_solver_plan(options, &facts, &solver->plan);
    if (may_change(solver) && solver->aim.first > solver->plan.first)
        solver->plan.first = solver->aim.first;
    tell_plan(solver);
    if (solver->matrix->global_rows > 0)
        status = build_first(solver, options);
    const int has_no_room = status == OST_OUT_OF_MEMORY || status == OST_LIMIT_EXCEEDED;
    if (has_no_room && solver->singular && solver->steps > 0)
        status = refuse_singular(solver->ctx, &solver->step[solver->steps - 1]);
    return status == OST_SUCCESS ? status : raise_all(solver->ctx, solver->step, solver->steps, status);
}

OstStatus ost_solver_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstSolver **solver)
{
    OstSolver *made = NULL;
    *solver = NULL;
    OstStatus status = ost_solver_check_options(ctx, options);
    OST_THEN(OST_NEW(ctx, &made, 1));
    OST_TRY_DONE(ost_agree(ctx, status));
    made->ctx = ctx;
    made->matrix = matrix;
    made->geometry = *geometry;
    made->options = *options;
    made->nonzeros = 9.0 * matrix->row_start[matrix->rows];
    OST_TRY_DONE(ost_sum(ctx, 1, &made->nonzeros));
    OST_TRY_DONE(ost_epetra_map_create(ctx, 3 * matrix->rows, &made->map));
    status = start(made, options, 0);
done:
    if (status != OST_SUCCESS)
        ost_solver_destroy(&made);
    *solver = made;
    return status;
}

OstStatus ost_solver_update(OstSolver *solver, OstSolverUpdate how)
{
    /* PLAIN's smoother would combine the new matrix with the old eigenvalue bounds and may not be definite. */
    const int may_stay = solver->method >= OST_METHOD_METRIC && solver->method <= OST_METHOD_TWO_LEVEL;
    if (how == OST_UPDATE_KEEP && may_stay) {
        solver->aged = 1;
        ost_saddle_factors_destroy(&solver->whole);
        return OST_SUCCESS;
    }
    destroy_strategy(solver);
    return start(solver, &solver->options, 1);
}

void ost_solver_aim(OstSolver *solver, OstSolverAim aim)
{
    solver->aim = aim;
}

void ost_solver_destroy(OstSolver **solver)
{
    if (!*solver)
        return;
    if (!(*solver)->is_shared) {
        destroy_strategy(*solver);
        ost_epetra_map_destroy(&(*solver)->map);
    }
    OST_FREE(*solver);
}

/* ||f - A u|| / ||f|| by Epetra's norms: shares only the residual with what the strategies stop by. */
static OstStatus measure_residual(const OstSolver *solver, const double *f, const double *u, int compensated,
                                  double *relative)
{
    OstContext *ctx = solver->ctx;
    const size_t n = 3 * (size_t)solver->matrix->rows;
    double *residual = NULL, norm = 0.0, f_norm = 0.0;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &residual, n + 3 * (size_t)solver->matrix->columns)));
    double *vector = residual + n;
    memcpy(vector, u, n * sizeof *u);
    OST_TRY_DONE(ost_residual(solver->matrix, f, vector, compensated, residual));
    OST_TRY_DONE(ost_epetra_norm(solver->map, residual, &norm));
    OST_TRY_DONE(ost_epetra_norm(solver->map, f, &f_norm));
    *relative = f_norm > 0.0 ? norm / f_norm : norm;
done:
    OST_FREE(residual);
    return status;
}

/* Improves u by the current strategy. */
static OstStatus work(OstSolver *solver, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    const double start = ost_own_seconds(solver->ctx);
    const int before = goal->iterations;
    const OstStatus status = improve(solver, f, u, goal, report);
    const char *outcome = status != OST_SUCCESS          ? ost_error_text(solver->ctx)
                          : goal->enough                 ? "the error is small enough"
                          : goal->end == OST_END_REACHED ? "reached the requested residual"
                                                         : goal->words;
    OstSolveStep *step = note_step(report->step, &report->steps, solver->method, outcome);
    step->iterations = goal->iterations - before;
    step->factor = step->iterations > 0 ? ost_convergence_whole_factor(&goal->convergence) : 0.0;
    step->relative_residual = goal->start > 0.0 ? goal->norm / goal->start : 0.0;
    step->seconds = ost_own_seconds(solver->ctx) - start + solver->strategy_seconds;
    ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: %s (%s): %d iterations in %.3f s to a residual of %.2e: %s",
            ost_method_name(step->method), report->engine, step->iterations, ost_own_seconds(solver->ctx) - start,
            step->relative_residual, step->outcome);
    solver->strategy_seconds = 0.0;
    solver->broken &= ~(1U << solver->method);
    if (goal->end == OST_END_PRECONDITIONER)
        solver->broken |= 1U << solver->method;
    if (solver->method == OST_METHOD_METRIC)
        solver->over_linear = ost_metric_is_over_linear(solver->metric);
    return status;
}

/* Could the same strategy succeed with more digits? The softest motion of a slender body has 1e-8 of the energy of its
 * nodes' and less: single precision may make a coarse level that has it indefinite. */
static int may_be_precise(const OstSolver *solver, const OstGoal *goal)
{
    return goal->end == OST_END_PRECONDITIONER && solver->metric && !solver->precise && !solver->is_shared;
}

/* Is there a next strategy that could succeed? */
static int should_change(const OstSolver *solver, const OstGoal *goal, const OstSolveReport *report)
{
    const int has_another = solver->fine && ost_solver_fastest(solver, report) != OST_METHOD_AUTO;
    const int fails = goal->end == OST_END_PRECONDITIONER || goal->end == OST_END_STALLED;
    const int mendable = goal->end == OST_END_SLOW || (fails && !solver->aim.probing);
    const int is_last = goal->patience == 0 && !has_another; /* no other is left, or it is the user's */
    const int may = (may_change(solver) && !is_last) || may_be_precise(solver, goal);
    return may && mendable && !solver->aged && solver->method < OST_METHOD_DIRECT;
}

/* Builds the next strategy, or the same one with more digits; if memory does not allow it, one that goes on. */
static OstStatus take_next(OstSolver *solver, OstGoal *goal, OstSolveReport *report)
{
    const int again = may_be_precise(solver, goal);
    OstMethod next = solver->method;
    if (!again)
        OST_TRY(ost_solver_next(solver, &next));
    solver->precise |= again;
    goal->scale = 0.0;
    OstStatus status = OST_OUT_OF_MEMORY;
    const int early = next == OST_METHOD_DIRECT && solver->method == OST_METHOD_METRIC;
    if (!solver->fine || again)
        status = build(solver, next, report->step, &report->steps);
    if (early && is_mendable(status))
        status = build(solver, OST_METHOD_STRONG, report->step, &report->steps);
    if (status != OST_OUT_OF_MEMORY && status != OST_LIMIT_EXCEEDED)
        return status;
    if (goal->singular || solver->singular)
        status = refuse_singular(solver->ctx, &report->step[report->steps - 1]);
    const OstMethod best = ost_solver_choose_last(solver, report);
    if (best == OST_METHOD_AUTO)
        return status;
    goal->patience = 0; /* there is no other to change to */
    OST_TRY(build(solver, best, report->step, &report->steps));
    ost_solver_tell_last(solver, goal, report);
    return OST_SUCCESS;
}

static OstStatus run_strategies(OstSolver *solver, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    goal->patience = may_change(solver) && !solver->fine ? solver->plan.options.patience : 0;
    OST_TRY(work(solver, f, u, goal, report));
    while (should_change(solver, goal, report)) {
        OST_TRY(take_next(solver, goal, report));
        OST_TRY(work(solver, f, u, goal, report));
    }
    return OST_SUCCESS;
}

/* The user's stop, for a system solved with f and u divided by `size`. */
typedef struct ScaledStop {
    OstContext *ctx;
    OstErrorStop stop;
    const OstErrorStop *user;
    double size;
    double *u; /* with room for 3 × rows */
    size_t n;
    double *p; /* of a mixed form: its pressures, which are scaled for the user and back; else NULL */
    size_t m;
    double seconds; /* that the user's took */
} ScaledStop;

static OstStatus ask_user(void *data, const double *u, double error, double *next)
{
    ScaledStop *scaled = data;
    const double start = ost_own_seconds(scaled->ctx);
    for (size_t i = 0; i < scaled->n; i++)
        scaled->u[i] = scaled->size * u[i];
    for (size_t i = 0; i < scaled->m; i++)
        scaled->p[i] *= scaled->size; /* a power of two */
    *next *= scaled->size;
    const OstStatus status = scaled->user->ask(scaled->user->data, scaled->u, scaled->size * error, next);
    *next /= scaled->size;
    for (size_t i = 0; i < scaled->m; i++)
        scaled->p[i] /= scaled->size;
    scaled->seconds += ost_own_seconds(scaled->ctx) - start;
    return status;
}

/* `room` for u where the user stops. */
static void set_stop(ScaledStop *stop, double size, double *room)
{
    stop->size = size;
    if (!stop->user)
        return;
    stop->u = room;
    stop->stop.relative = stop->user->relative;
    stop->stop.first = stop->user->first / (stop->user->relative ? 1.0 : size);
}

static void report_goal(const OstGoal *goal, double size, OstSolveReport *report)
{
    report->iterations = goal->iterations;
    report->indefinite = goal->indefinite;
    report->algebraic_error = size * goal->error.estimate;
    report->algebraic_bound = size * goal->error.bound;
    report->stopped = goal->enough;
    report->iterations_saved = ost_goal_saved(goal);
    if (!(goal->start > 0.0))
        return;
    report->relative_residual = goal->norm / goal->start;
    report->attainable_residual = ost_goal_attainable(goal);
    report->rounding_limited = goal->end == OST_END_ROUNDING;
}

/* A stiff part may have strains that are far off, and with them its stresses and the reactions, where it has next to
 * none of the energy that tells a solve to stop. */
static int is_uneven(const OstSolver *solver)
{
    static const double uneven = 1e6;
    return solver->geometry.facts && solver->geometry.facts->contrast > uneven;
}

/* Solves with f scaled to order 1. */
static OstStatus solve_scaled(OstSolver *solver, const double *f, double *u, const ScaledStop *stop,
                              OstSolveReport *report)
{
    OstGoal goal;
    if (solver->method == OST_METHOD_AUTO && solver->matrix->global_rows > 0)
        return OST_RAISE(
            solver->ctx, OST_NOT_CONVERGED,
            "no strategy of this solver is left: an earlier solve tried all; update or create the solver again");
    OST_TRY(ost_goal_set(solver->matrix, f, &solver->plan.options, &goal));
    if (solver->saddle)
        OST_TRY(ost_saddle_goal(solver->matrix, solver->saddle, f, solver->plan.options.relative_residual, &goal));
    if (solver->aim.relative_residual > 0.0)
        goal.target = solver->aim.relative_residual * goal.start;
    goal.crude = solver->aim.crude;
    goal.scale = solver->aim.goes_on ? solver->scale : 0.0;
    goal.stop = stop->user && !is_uneven(solver) ? &stop->stop : NULL;
    OstStatus status = OST_SUCCESS;
    if (solver->method != OST_METHOD_AUTO)
        status = run_strategies(solver, f, u, &goal, report);
    report->method = solver->method != OST_METHOD_AUTO ? solver->method : solver->plan.first;
    solver->smallest = goal.smallest;
    solver->scale = goal.scale;
    report_goal(&goal, stop->size, report);
    OST_THEN(ost_goal_verdict(&goal));
    if (status == OST_NOT_CONVERGED && goal.end == OST_END_STALLED && (goal.singular || solver->singular))
        status = raise_singular(solver->ctx);
    if (status == OST_NOT_CONVERGED && goal.end == OST_END_PRECONDITIONER && !solver->is_shared &&
        solver->plan.options.method != OST_METHOD_AUTO)
        status = raise_fixed(solver, status);
    if (status != OST_SUCCESS)
        return raise_all(solver->ctx, report->step, report->steps, status);
    if (goal.crude || solver->saddle)
        return OST_SUCCESS;
    return measure_residual(solver, f, u, goal.compensated, &report->relative_residual);
}

static OstStatus solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    const size_t n = 3 * (size_t)solver->matrix->rows;
    ScaledStop stop = {.ctx = solver->ctx, .stop = {.ask = ask_user, .data = &stop}, .user = solver->aim.stop, .n = n};
    double *scaled = NULL;
    OST_TRY(ost_vector_size(solver->ctx, n, f, &stop.size));
    OST_TRY(ost_agree(solver->ctx, OST_NEW(solver->ctx, &scaled, stop.user ? 2 * n : n)));
    for (size_t i = 0; i < n; i++) {
        scaled[i] = f[i] / stop.size;
        u[i] = solver->aim.goes_on ? u[i] / stop.size : 0.0;
    }
    set_stop(&stop, stop.size, scaled + n);
    const OstStatus status = solve_scaled(solver, scaled, u, &stop, report);
    for (size_t i = 0; i < n; i++)
        u[i] *= stop.size;
    OST_FREE(scaled);
    report->solve_seconds = -stop.seconds;
    return status;
}

/* f and u have been divided by `size`: so are g and p. */
static OstStatus solve_mixed(OstSolver *solver, const OstSaddle *saddle, const double *f, double *u,
                             OstSolveReport *report)
{
    const size_t n = 3 * (size_t)solver->matrix->rows, m = (size_t)saddle->coupling->rows;
    ScaledStop stop = {.ctx = solver->ctx,
                       .stop = {.ask = ask_user, .data = &stop},
                       .user = solver->aim.stop,
                       .n = n,
                       .p = saddle->p,
                       .m = m};
    double *scaled = NULL, size;
    OST_TRY(ost_vector_size(solver->ctx, n, f, &size));
    OST_TRY(ost_agree(solver->ctx, OST_NEW(solver->ctx, &scaled, stop.user ? 2 * n + m : n + m)));
    set_stop(&stop, size, scaled + n + m);
    const OstSaddle within = {saddle->coupling, scaled + n, saddle->p};
    for (size_t i = 0; i < n; i++) {
        scaled[i] = f[i] / size;
        u[i] = solver->aim.goes_on ? u[i] / size : 0.0;
    }
    for (size_t i = 0; i < m; i++) {
        scaled[n + i] = saddle->g[i] / size;
        saddle->p[i] = solver->aim.goes_on ? saddle->p[i] / size : 0.0;
    }
    solver->saddle = &within;
    const OstStatus status = solve_scaled(solver, scaled, u, &stop, report);
    solver->saddle = NULL;
    for (size_t i = 0; i < n; i++)
        u[i] *= size;
    for (size_t i = 0; i < m; i++)
        saddle->p[i] *= size;
    OST_FREE(scaled);
    report->solve_seconds = -stop.seconds;
    return status;
}

OstStatus ost_solver_solve_mixed(OstSolver *solver, const OstSaddle *saddle, const double *f, double *u,
                                 OstSolveReport *report)
{
    memset(report, 0, sizeof *report);
    report->plan = solver->plan;
    report->nonzeros = solver->nonzeros;
    report->steps = solver->steps;
    memcpy(report->step, solver->step, sizeof solver->step);
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    const double start = ost_own_seconds(solver->ctx), setup = solver->setup_seconds;
    const OstStatus status = saddle ? solve_mixed(solver, saddle, f, u, report) : solve(solver, f, u, report);
    report->setup_seconds = solver->setup_seconds;
    report->solve_seconds += ost_own_seconds(solver->ctx) - start - (solver->setup_seconds - setup);
    ost_ledger_leave(solver->ctx);
    return status;
}

OstStatus ost_solver_solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    return ost_solver_solve_mixed(solver, NULL, f, u, report);
}

OstStatus ost_solver_error(OstSolver *solver, double missing, const double *residual, double *error, int *found)
{
    OstCgSystem system;
    OstPreconditioner preconditioner;
    *found = 0;
    if (!ost_solver_has_preconditioner(solver) || !(solver->smallest > 0.0))
        return OST_SUCCESS;
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    ost_solver_system(solver, &system, &preconditioner);
    const OstStatus status =
        ost_error_of_residual(&system, &preconditioner, solver->smallest, missing, residual, error, found);
    ost_ledger_leave(solver->ctx);
    return status;
}

OstStatus ost_solver_precondition(OstSolver *solver, OstCyclePart part, const double *r, double *z, int *found)
{
    OstCgSystem system;
    OstPreconditioner preconditioner;
    double *scaled = NULL;
    *found = ost_solver_has_preconditioner(solver);
    if (!*found)
        return OST_SUCCESS;
    OST_TRY(ost_agree(solver->ctx, OST_NEW_UNCLEARED(solver->ctx, &scaled, 3 * (size_t)solver->matrix->rows)));
    ost_solver_system(solver, &system, &preconditioner);
    if (part == OST_CYCLE_BRIEF && preconditioner.brief)
        preconditioner.apply = preconditioner.brief;
    else if (part != OST_CYCLE_WHOLE && preconditioner.half)
        preconditioner.apply = preconditioner.half;
    const OstStatus status = ost_precondition(&system, &preconditioner, r, scaled, z);
    OST_FREE(scaled);
    return status;
}

int ost_solver_shares(const OstSolver *solver)
{
    return solver->metric != NULL;
}

OstStatus ost_solver_share(const OstSolver *solver, OstSolver **shared)
{
    OST_TRY(OST_NEW(solver->ctx, shared, 1));
    **shared = *solver;
    (*shared)->is_shared = 1;
    (*shared)->aim = (OstSolverAim){0};
    return OST_SUCCESS;
}

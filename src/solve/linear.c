/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/linear.h"

#include "accuracy/stop.h"
#include "algebra/krylov/energy_error.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "core/together/together.h"
#include "problem/free_body.h"
#include "solve/distributing/distributing.h"
#include "solve/error.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* An error so many times what is good enough is not waited for, but solved for to the end. */
static const double most_beyond = 100.0;

static void release(OstAnalysis *analysis)
{
    OstLinear *linear = analysis->work;
    if (!linear)
        return;
    ost_stiffness_solver_release(&linear->stiffness);
    OST_FREE(linear->rhs);
    OST_FREE(linear->v);
    OST_FREE(linear->volume);
    OST_FREE(linear->pressure);
    OST_FREE(analysis->work);
}

/* The stiffness is filled once: its scatter map is not needed again. */
static OstStatus prepare_stiffness(OstAnalysis *analysis, OstVerdict *before)
{
    OstContext *ctx = analysis->ctx;
    OstProblem *problem = analysis->problem;
    OST_TRY(ost_problem_stiffness(problem, 1.0, NULL, NULL));
    ost_problem_release_scatter(problem);
    OST_TRY(ost_problem_fold_stiffness(problem));
    OstLinear *linear = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &linear, 1)));
    analysis->work = linear;
    const size_t unknowns = 3 * (size_t)problem->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &linear->rhs, unknowns);
    OST_THEN(OST_NEW(ctx, &linear->v, unknowns));
    if (problem->pressures) {
        OST_THEN(OST_NEW(ctx, &linear->volume, problem->pressures->owned));
        OST_THEN(OST_NEW(ctx, &linear->pressure, ost_problem_pressure_room(problem)));
    }
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_stiffness_solver_create(problem, &analysis->options, &linear->stiffness));
    ost_row_geometry_lend(&linear->stiffness.rows);
    return ost_guard_stiffness(problem, linear->stiffness.rows.modes, &linear->rigid_motion, before);
}

static OstStatus prepare(OstAnalysis *analysis, OstVerdict *before)
{
    OstProblem *problem = analysis->problem;
    if (!analysis->work)
        OST_TRY(prepare_stiffness(analysis, before));
    OstLinear *linear = analysis->work;
    ost_distributing_forget(problem);
    if (!linear->has_rhs)
        OST_TRY(ost_problem_right_hand_side(problem, 1.0, linear->rhs));
    if (linear->volume) {
        OST_TRY(ost_problem_volume(problem, 1.0, linear->volume));
        OST_TRY(ost_guard_volume(problem, linear->volume, &linear->enclosed, before));
    }
    return ost_guard_load(problem, 0, linear->rhs, before);
}

static OstStatus describe_rhs(const OstProblem *problem, const OstLinear *linear, OstSolvedFor *solved_for)
{
    const size_t unknowns = 3 * (size_t)problem->system->matrix->rows;
    double sums[2] = {0.0};
    for (size_t i = 0; i < unknowns; i++) {
        sums[0] += linear->rhs[i] * linear->rhs[i];
        sums[1] += linear->rhs[i] * linear->v[i];
    }
    OST_TRY(ost_sum(problem->ctx, 2, sums));
    *solved_for = (OstSolvedFor){.norm = sqrt(sums[0]), .work = sums[1]};
    if (!linear->volume)
        return OST_SUCCESS;
    const OstSaddle saddle = {problem->coupling, linear->volume, linear->pressure};
    return ost_saddle_size(problem->system->matrix, &saddle, linear->rhs, &solved_for->norm);
}

/* Takes the unknowns of the displacement to start from, if there is one. */
static int take_start(const OstAnalysis *analysis)
{
    const OstSystem *system = analysis->problem->system;
    const OstLinear *linear = analysis->work;
    if (system->supports->links) /* the rows of rigid faces are no displacements of nodes */
        return 0;
    for (OstLocal row = 0; analysis->start && row < system->matrix->rows; row++) {
        const OstLocal node = system->node_of_row[row];
        double projector[9];
        ost_supports_get(system->supports, node, projector, NULL);
        ost_apply3(projector, analysis->start + 3 * (size_t)node, linear->v + 3 * (size_t)row);
    }
    return analysis->start != NULL;
}

/* A mixed form would need a pressure to start from. */
static int begins_at_start(const OstAnalysis *analysis)
{
    return !analysis->problem->pressures && take_start(analysis);
}

/* By the solver, of the right-hand side that is there. */
static OstStatus solve_equations(const OstAnalysis *analysis, OstSolveReport *report)
{
    OstLinear *linear = analysis->work;
    OstSolver *solver = linear->stiffness.solver;
    if (!linear->volume)
        return ost_solver_solve(solver, linear->rhs, linear->v, report);
    const OstSaddle saddle = {analysis->problem->coupling, linear->volume, linear->pressure};
    const OstStatus solved = ost_solver_solve_mixed(solver, &saddle, linear->rhs, linear->v, report);
    if (linear->enclosed)
        OST_TRY(ost_problem_centre_pressure(analysis->problem, linear->pressure));
    return solved;
}

/* The stop of a mixed form, whose estimate needs the pressures reached. */
typedef struct MixedStop {
    OstErrorStop stop;
    const OstErrorStop *inner;
    const OstAnalysis *analysis;
    OstResult *result;
} MixedStop;

static OstStatus tell_pressure(const OstAnalysis *analysis, OstResult *result)
{
    const OstPressureSpace *space = analysis->problem->pressures;
    double *pressure = ((OstLinear *)analysis->work)->pressure;
    OST_TRY(ost_pressure_complete(space, pressure));
    ost_pressure_of_tets(space, pressure, result->pressure);
    return OST_SUCCESS;
}

static OstStatus ask_mixed(void *data, const double *u, double error, double *next)
{
    const MixedStop *stop = data;
    OST_TRY(tell_pressure(stop->analysis, stop->result));
    return stop->inner->ask(stop->inner->data, u, error, next);
}

/* The displacement of what was solved for. */
static OstStatus tell_displacement(const OstAnalysis *analysis, OstStatus solved, OstResult *result)
{
    const OstProblem *problem = analysis->problem;
    const OstLinear *linear = analysis->work;
    OST_TRY(ost_problem_displacement(problem, 1.0, linear->v, result->displacement));
    if (linear->volume)
        OST_TRY(tell_pressure(analysis, result));
    result->reached = solved == OST_SUCCESS || solved == OST_NOT_CONVERGED;
    if (result->reached && problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, result->displacement));
    return OST_SUCCESS;
}

/* Solves from 0 or, to go on, from linear->v. */
static OstStatus run_solver(const OstAnalysis *analysis, const OstErrorStop *stop, int goes_on, OstResult *result)
{
    OstLinear *linear = analysis->work;
    const int before = goes_on ? result->solve.iterations : 0;
    const double seconds = goes_on ? result->solve.solve_seconds : 0.0;
    MixedStop mixed = {.inner = stop, .analysis = analysis, .result = result};
    OST_FREE(result->internal);
    if (stop && linear->volume) {
        mixed.stop = (OstErrorStop){.ask = ask_mixed, .data = &mixed, .first = stop->first, .relative = stop->relative};
        stop = &mixed.stop;
    }
    ost_solver_aim(linear->stiffness.solver, (OstSolverAim){.stop = stop, .goes_on = goes_on});
    const OstStatus solved = solve_equations(analysis, &result->solve);
    ost_solver_aim(linear->stiffness.solver, (OstSolverAim){0});
    result->solve.iterations += before;
    result->solve.solve_seconds += seconds;
    OST_TRY(tell_displacement(analysis, solved, result));
    return solved;
}

/* What the solver would report of v, with the error that those of the parts add up to at most. */
static OstStatus report_sum(const OstAnalysis *analysis, OstSolveReport *report)
{
    const OstLoadSum *sum = analysis->sum;
    const OstLinear *linear = analysis->work;
    const OstBlockMatrix *matrix = analysis->problem->system->matrix;
    const size_t unknowns = 3 * (size_t)matrix->rows;
    double squares[3] = {0.0}, *room = NULL;
    *report = sum->result[0]->solve;
    report->iterations = report->iterations_saved = report->steps = 0;
    report->solve_seconds = report->algebraic_error = report->algebraic_bound = 0.0;
    for (int k = 0; k < sum->count; k++) {
        const OstSolveReport *part = &sum->result[k]->solve;
        report->algebraic_error += fabs(sum->factor[k]) * part->algebraic_error;
        report->algebraic_bound += fabs(sum->factor[k]) * part->algebraic_bound;
        report->condition_estimate = fmax(report->condition_estimate, part->condition_estimate);
        report->rounding_limited |= part->rounding_limited;
    }
    OST_TRY(ost_agree(analysis->ctx, OST_NEW(analysis->ctx, &room, unknowns + 3 * (size_t)matrix->columns)));
    double *u = room + unknowns;
    memcpy(u, linear->v, unknowns * sizeof *u);
    OstStatus status = ost_block_matrix_apply(matrix, u, room);
    for (size_t i = 0; i < unknowns; i++) {
        squares[0] += (linear->rhs[i] - room[i]) * (linear->rhs[i] - room[i]);
        squares[1] += linear->rhs[i] * linear->rhs[i];
        squares[2] += linear->v[i] * room[i];
    }
    OST_FREE(room);
    OST_THEN(ost_sum(analysis->ctx, 3, squares));
    report->relative_residual = sqrt(squares[0] / squares[1]);
    report->error_estimate = report->energy_error = report->algebraic_error / sqrt(squares[2]);
    return status;
}

/* The answer as a sum of others; *suffices, if the stop says so. */
static OstStatus add_up(const OstAnalysis *analysis, const OstErrorStop *stop, OstResult *result, int *suffices)
{
    const OstLoadSum *sum = analysis->sum;
    OstLinear *linear = analysis->work;
    double next = 0.0;
    memset(linear->v, 0, 3 * (size_t)analysis->problem->system->matrix->rows * sizeof *linear->v);
    for (int k = 0; k < sum->count; k++) {
        const OstLinear *part = sum->of[k]->work;
        for (size_t i = 0; i < 3 * (size_t)analysis->problem->system->matrix->rows; i++)
            linear->v[i] += sum->factor[k] * part->v[i];
    }
    OST_TRY(report_sum(analysis, &result->solve));
    OST_TRY(stop->ask(stop->data, linear->v, result->solve.algebraic_error, &next));
    *suffices = next >= result->solve.algebraic_error;
    return *suffices ? tell_displacement(analysis, OST_SUCCESS, result) : OST_SUCCESS;
}

/* `error`: becomes that of the displacement, 3 × node_count; or NULL. */
static OstStatus find_errors(const OstAnalysis *analysis, OstResult *result, double enough, double *error,
                             OstErrors *errors)
{
    const OstLinear *linear = analysis->work;
    const OstSolved solved = {&result->solve,   linear->rhs,      linear->v,         result->displacement,
                              linear->pressure, result->pressure, &result->internal, error};
    OstProblem state = *analysis->problem; /* with the pressure reached, if there is one */
    state.field = result->field;
    OST_FREE(result->internal);
    ost_together_gather(analysis->ctx); /* from here on all load cases have the same to do */
    if (linear->enclosed) { /* what the solver has estimated: nothing tells the mean pressure, so none of its error */
        const double estimate = result->solve.error_estimate;
        *errors =
            (OstErrors){.known = estimate > 0.0, .displacement = estimate, .reaction = estimate, .stress = estimate};
        return OST_SUCCESS;
    }
    return linear->volume ? ost_find_mixed_errors(&state, linear->stiffness.solver, &solved, enough, errors)
                          : ost_find_errors(&state, linear->stiffness.solver, &solved, enough, errors);
}

/* Where stresses are watched, what the equations leave of them is no more than this share of the discretisation error,
 * or small. */
static const double of_watched = 0.1, small_stress = 1e-3;

/* So much of the largest error of a displacement is looked at once, though it be part of a watched one. */
static const double small_displacement = 0.1;

double ost_stop_excess(const OstErrors *errors, const OstAnswerError *answer, int watches_stress)
{
    const double of_displacement = errors->displacement / fmax(answer->displacement, 0.1 * answer->relative);
    double of_forces = fmax(errors->reaction, errors->stress) / ost_least_digit;
    if (watches_stress)
        of_forces = fmax(of_forces, errors->stress / fmax(of_watched * answer->relative, small_stress));
    return errors->known ? fmax(of_displacement, of_forces) : INFINITY;
}

/* Solves until the error of the equations is small beside that of the discretisation. Where that proves too early, goes
 * on to a smaller one, and in the end to the residual asked for. `error`: room for 3 × node_count where something is
 * watched: what the stop leaves is then in its error; else NULL. */
static OstStatus solve_to_stop(const OstAnalysis *analysis, OstSolveStop *stop, double *error, OstResult *result,
                               OstErrors *errors)
{
    enum { ROUNDS = 3 };
    for (int round = 0; round < ROUNDS; round++) {
        int is_sum = 0;
        if (round == 0 && analysis->sum)
            OST_TRY(add_up(analysis, &stop->stop, result, &is_sum));
        if (!is_sum)
            OST_TRY(run_solver(analysis, &stop->stop, round > 0 || analysis->sum || begins_at_start(analysis), result));
        if (!result->solve.stopped)
            return OST_SUCCESS;
        OST_TRY(find_errors(analysis, result, fmax(small_displacement * result->answer.displacement, DBL_MIN), error,
                            errors));
        const double beyond =
            ost_stop_excess(errors, &result->answer, result->stress_surplus || result->node_stress_surplus);
        if (beyond <= 1.0) {
            if (error)
                ost_estimate_add(stop->estimate, error, &stop->surplus);
            return OST_SUCCESS;
        }
        const int again = !errors->known && round == 0; /* by a hierarchy of more digits, if this one is indefinite */
        if (!(beyond < most_beyond || again))
            break;
        ost_solve_stop_tighten(stop, 0.5 * result->solve.algebraic_error / (again ? 1.0 : beyond));
    }
    return run_solver(analysis, NULL, 1, result);
}

static OstStatus stop_early(const OstAnalysis *analysis, OstResult *result, OstErrors *errors)
{
    const OstProblem *problem = analysis->problem;
    const OstLinear *linear = analysis->work;
    OstProblem state = *problem; /* with the pressure reached, if there is one */
    OstSolveStop stop;
    double *error = NULL;
    state.field = result->field;
    OST_TRY(ost_result_allow_error(problem, result));
    if (result->surplus)
        OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &error, 3 * (size_t)problem->mesh->node_count)));
    const OstSurplus surplus = ost_result_surplus(result);
    OstStatus solved = ost_solve_stop_open(&state, linear->stiffness.solver, analysis->options.algebraic_fraction,
                                           analysis->estimate, &surplus, &result->answer, &stop);
    if (solved == OST_SUCCESS) {
        solved = solve_to_stop(analysis, &stop, error, result, errors);
        ost_solve_stop_close(&stop);
    }
    OST_FREE(error);
    return solved;
}

/* The load of distributing couplings whose motion is given; an estimate that is kept is told of it. */
static OstStatus drive(OstAnalysis *analysis)
{
    OstLinear *linear = analysis->work;
    OST_TRY(ost_distributing_find(analysis->problem, linear->stiffness.solver, 0, linear->rhs, linear->volume));
    OST_TRY(ost_problem_right_hand_side(analysis->problem, 1.0, linear->rhs));
    return ost_analysis_take_loading(analysis);
}

static OstStatus solve(OstAnalysis *analysis, OstResult *result, OstSolvedFor *solved_for)
{
    const OstProblem *problem = analysis->problem;
    OstLinear *linear = analysis->work;
    OstErrors errors = {0};
    const int may_stop = analysis->options.algebraic_fraction > 0.0 && (result->asked >> OST_FIELD_ERROR & 1U) &&
                         ost_reactions_allow_stop(problem);
    result->checks.rigid_motion = linear->rigid_motion;
    if (!linear->stiffness.solver)
        OST_TRY(ost_stiffness_solver_make(&linear->stiffness));
    if (ost_distributing_any(problem))
        OST_TRY(drive(analysis));
    const OstStatus solved = may_stop ? stop_early(analysis, result, &errors)
                                      : run_solver(analysis, NULL, begins_at_start(analysis), result);
    if (!result->reached)
        return solved;
    if (solved == OST_SUCCESS && !result->solve.stopped)
        OST_TRY(find_errors(analysis, result, 0.0, NULL, &errors));
    OST_TRY(describe_rhs(problem, linear, solved_for));
    if (!linear->enclosed)
        solved_for->errors = errors;
    return solved;
}

OstStatus ost_linear_load(OstAnalysis *analysis, int function, OstVerdict *before)
{
    const OstProblem *problem = analysis->problem;
    OstLinear *linear = analysis->work;
    OST_TRY(ost_problem_function_right_hand_side(problem, function, linear->rhs));
    if (linear->volume) {
        OST_TRY(ost_problem_function_volume(problem, function, linear->volume));
        OST_TRY(ost_guard_volume(problem, linear->volume, &linear->enclosed, before));
    }
    return ost_guard_load(problem, function, linear->rhs, before);
}

static OstStatus measure_rhs(const OstProblem *problem, const OstLinear *linear, double *norm)
{
    const OstSaddle saddle = {problem->coupling, linear->volume, linear->pressure};
    double square = 0.0;
    if (linear->volume)
        return ost_saddle_size(problem->system->matrix, &saddle, linear->rhs, norm);
    for (size_t i = 0; i < 3 * (size_t)problem->system->matrix->rows; i++)
        square += linear->rhs[i] * linear->rhs[i];
    OST_TRY(ost_sum(problem->ctx, 1, &square));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

OstStatus ost_linear_solve(OstAnalysis *analysis, int function, OstSolveReport *report, double *norm,
                           double *displacement)
{
    OstProblem *problem = analysis->problem;
    OstLinear *linear = analysis->work;
    if (!linear->stiffness.solver)
        OST_TRY(ost_stiffness_solver_make(&linear->stiffness));
    if (ost_distributing_any(problem)) {
        OST_TRY(ost_distributing_find(problem, linear->stiffness.solver, function, linear->rhs, linear->volume));
        OST_TRY(ost_problem_function_right_hand_side(problem, function, linear->rhs));
    }
    OST_TRY(measure_rhs(problem, linear, norm));
    const OstStatus solved = solve_equations(analysis, report);
    if (solved != OST_SUCCESS && solved != OST_NOT_CONVERGED)
        return solved;
    OST_TRY(ost_problem_function_displacement(problem, function, linear->v, displacement));
    if (linear->volume) {
        OST_TRY(ost_pressure_complete(problem->pressures, linear->pressure));
        memcpy(displacement + 3 * (size_t)problem->mesh->node_count, linear->pressure,
               (size_t)problem->pressures->count * sizeof *displacement);
    }
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, displacement));
    return solved;
}

/* The right-hand side has no part that supports take, so the displacement's own does not matter. */
OstStatus ost_linear_work(const OstAnalysis *analysis, double t, const double *displacement, double *work)
{
    const OstProblem *problem = analysis->problem;
    const OstSystem *system = problem->system;
    OstLinear *linear = analysis->work;
    *work = 0.0;
    OST_TRY(ost_problem_right_hand_side(problem, t, linear->rhs));
    for (OstLocal row = 0; row < system->matrix->rows; row++)
        *work += ost_dot3(linear->rhs + 3 * (size_t)row, displacement + 3 * (size_t)system->node_of_row[row]);
    return ost_sum(analysis->ctx, 1, work);
}

const OstStrategy ost_linear_strategy = {.prepare = prepare, .solve = solve, .release = release};

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "solve/distributing/turned.h"
#include "solve/linear.h"
#include "solve/path_data.h"

#include <math.h>
#include <string.h>

/* A displacement of this share of the body's size is rounding, where no load makes it. */
static const double least_share = 1e-12;

static OstStatus check_times(OstContext *ctx, int count, const double *times)
{
    for (int i = 0; i < count; i++)
        if (!(times[i] >= 0.0) || !isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "time %d of a path is %g; expected times that ascend, the first not negative", i + 1,
                             times[i]);
    return count > 0 ? OST_SUCCESS : OST_RAISE(ctx, OST_INVALID_INPUT, "a path has one step at least; found none");
}

OstStatus ost_path_create(OstProblem *problem, const OstSolverOptions *options, int count, const double *times,
                          OstPath **path)
{
    OstContext *ctx = problem->ctx;
    OstPath *made = NULL;
    *path = NULL;
    OST_TRY(check_times(ctx, count, times));
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        *made = (OstPath){.ctx = ctx, .problem = problem, .count = count};
        status = OST_NEW(ctx, &made->times, count);
        OST_THEN(OST_NEW(ctx, &made->steps, count));
    }
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS)
        memcpy(made->times, times, (size_t)count * sizeof *times);
    if (problem->pressures && !ost_nonlinear_may_be_mixed(problem))
        OST_THEN(ost_problem_leave_mixed(problem));
    OST_THEN(ost_analysis_create(problem, options, &made->analysis));
    if (status != OST_SUCCESS)
        ost_path_destroy(&made);
    *path = made;
    return status;
}

OstStatus ost_scene_path(const OstScene *scene, OstPath **path)
{
    const OstCase *c = scene->c;
    OstProblem *problem = NULL;
    *path = NULL;
    if (c->path_steps == 0)
        return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s: the case has no path; add one, as in path: {steps: 10}",
                         c->path);
    OstStatus status = ost_scene_problem(scene, &problem);
    OST_THEN(ost_path_create(problem, &c->solver, c->path_steps, c->path_times, path));
    if (status == OST_SUCCESS)
        (*path)->owned = problem;
    else
        ost_problem_destroy(&problem);
    return status;
}

void ost_path_destroy(OstPath **path)
{
    if (!*path)
        return;
    ost_superposition_release(&(*path)->linear);
    ost_newton_state_release(&(*path)->state);
    if ((*path)->analysis)
        ost_analysis_destroy(&(*path)->analysis);
    ost_problem_destroy(&(*path)->owned);
    OST_FREE((*path)->times);
    OST_FREE((*path)->steps);
    OST_FREE(*path);
}

/* Done once, whatever the number of steps, unless linear theory is not wanted any more. What a checkpoint brings has no
 * solver, which error estimates and checks go on with: it is solved for again. */
static OstStatus solve_linearly(OstPath *path)
{
    const int begins = !path->analysis->work;
    if (begins)
        OST_TRY(ost_analysis_prepare(path->analysis));
    if (path->nonlinear || (path->linear.count > 0 && !begins))
        return OST_SUCCESS;
    ost_superposition_release(&path->linear);
    path->solved_linearly = ost_superposition_create(path->analysis, &path->linear);
    return path->linear.count > 0 ? OST_SUCCESS : path->solved_linearly;
}

/* The steps are Newton's, all of them, if the case says so, or if linear theory is too far off in one. */
static OstStatus decide(OstPath *path, OstResult *result)
{
    const OstProblem *problem = path->problem;
    OstSolvedFor solved_for;
    double most = 0.0, strained = 0.0; /* strain, and the time at which the body strains the most */
    path->decided = 1;
    if (problem->beyond_linear == OST_FORMULATION_LINEAR)
        return OST_SUCCESS;
    for (int i = 0; i < path->count; i++) {
        OST_TRY(ost_superposition_at(&path->linear, path->analysis, path->times[i], result, &solved_for));
        result->t = path->times[i];
        OST_TRY(ost_nonlinear_judge(problem, result));
        if (i == 0 || result->newton.linear_error > path->judged.linear_error)
            path->judged = result->newton;
        if (i == 0 || result->newton.linear_strain > most)
            strained = path->times[i];
        most = fmax(most, result->newton.linear_strain);
    }
    if (problem->automatic && path->judged.linear_error <= problem->accuracy) {
        OST_TRY(ost_superposition_at(&path->linear, path->analysis, strained, result, &solved_for));
        result->t = strained;
        OST_TRY(ost_nonlinear_look_closer(path->analysis, result));
        OST_FREE(result->left_out, result->left_out_reaction); /* of that time alone */
        if (result->buckling.known)
            ost_log(path->ctx, OST_LOG_NORMAL,
                    "by linear theory the body buckles at %.4g times what acts at t = %.4g: the path is Newton's",
                    result->buckling.factor[0], strained);
        result->buckling = (OstBuckling){0};
        path->judged.linear_change = result->newton.linear_change;
        path->judged.linear_error = fmax(path->judged.linear_error, result->newton.linear_error);
    }
    result->t = 1.0;
    path->nonlinear = !ost_nonlinear_stays_linear(problem, path->judged.linear_error);
    return OST_SUCCESS;
}

static OstStatus step_linearly(OstPath *path, double t, OstResult *result, OstSolvedFor *solved_for)
{
    OST_TRY(ost_superposition_at(&path->linear, path->analysis, t, result, solved_for));
    result->newton = path->judged;
    return path->solved_linearly;
}

/* The body without load, and where the linear answer at t takes it. */
static OstStatus begin(OstPath *path, double t, OstResult *result)
{
    const OstProblem *problem = path->problem;
    const OstLinear *linear = path->analysis->work;
    OstSolvedFor solved_for;
    OST_TRY(ost_agree(path->ctx, ost_newton_state_create(problem, &path->state)));
    path->state.t = ost_problem_begins_at_rest(problem) ? 0.0 : -1.0;
    const double span = t - path->state.t;
    if (!(span > 0.0))
        return OST_SUCCESS;
    OST_TRY(ost_superposition_at(&path->linear, path->analysis, t, result, &solved_for));
    OST_TRY(ost_nonlinear_judge(problem, result));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->node_count; i++)
        path->state.slope[i] = result->displacement[i] / span;
    for (OstLocal i = 0; problem->pressures && i < problem->pressures->count; i++)
        path->state.slope[3 * (size_t)problem->mesh->node_count + (size_t)i] = linear->pressure[i] / span;
    const size_t multipliers = (size_t)ost_turned_couplings_count(problem);
    double *multiplier = path->state.slope + ost_newton_state_size(problem) - multipliers;
    ost_turned_couplings_begin(problem, t, multiplier);
    for (size_t k = 0; k < multipliers; k++)
        multiplier[k] /= span;
    path->state.step = span * ost_newton_first_step(result->newton.linear_rotation);
    ost_superposition_release(&path->linear);
    return OST_SUCCESS;
}

/* Does a load grow from here on at another rate than it did? The last step's slope then leads astray. */
static int loads_turn(const OstPath *path, double t)
{
    if (path->done == 0)
        return 0;
    const OstProblem *problem = path->problem;
    const double now = path->times[path->done - 1], before = path->done > 1 ? path->times[path->done - 2] : 0.0;
    int turn = 0;
    for (int k = 0; k < ost_problem_functions(problem) && before < now; k++) {
        const double factor = ost_problem_factor(problem, k, now);
        const double was = (factor - ost_problem_factor(problem, k, before)) / (now - before);
        const double is = (ost_problem_factor(problem, k, t) - factor) / (t - now);
        turn |= fabs(is - was) > 0.5 * fmax(fabs(is), fabs(was));
    }
    return turn;
}

/* Does nothing act at t: no load, no eigenstrain, no displacement but zero? `zero` and `given` have room for 3 numbers
 * a node. */
static OstStatus find_idle(const OstPath *path, double t, const double *zero, double *given, int *idle)
{
    const OstProblem *problem = path->problem;
    const OstMesh *mesh = problem->mesh;
    const int swells = ost_field_is_eigenstrained(problem->field);
    double most = swells ? fabs(ost_problem_eigen_share(problem, t)) : 0.0;
    OST_TRY(ost_problem_displacement(problem, t, zero, given));
    for (size_t i = 0; i < 3 * (size_t)mesh->node_count; i++)
        most = fmax(most, fabs(given[i]));
    ost_problem_load(problem, t, zero, given);
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes; i++)
        most = fmax(most, fabs(given[i]));
    OST_TRY(ost_max(path->ctx, 1, &most));
    *idle = most == 0.0;
    return OST_SUCCESS;
}

/* Where nothing acts, and what is left of the displacement is rounding, the body is at rest: errors relative to such
 * an answer would mean nothing. */
static OstStatus come_to_rest(OstPath *path, double t, int *rests)
{
    const OstMesh *mesh = path->problem->mesh;
    const size_t count = 3 * (size_t)mesh->node_count;
    double low[3], high[3], most = 0.0, *zero = NULL, *given = NULL;
    *rests = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, fabs(path->state.displacement[i]));
    OST_TRY(ost_max(path->ctx, 1, &most));
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    if (most > least_share * fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]))
        return OST_SUCCESS;
    OstStatus status = OST_NEW(path->ctx, &zero, count);
    OST_THEN(OST_NEW(path->ctx, &given, count));
    status = ost_agree(path->ctx, status);
    OST_THEN(find_idle(path, t, zero, given, rests));
    if (status == OST_SUCCESS && *rests)
        memset(path->state.displacement, 0, ost_newton_state_size(path->problem) * sizeof *path->state.displacement);
    OST_FREE(zero);
    OST_FREE(given);
    return status;
}

/* Every step has its own method, so that it depends on the state alone. */
static OstStatus run_newton(OstPath *path, double t, OstResult *result, OstSolvedFor *solved_for)
{
    OstStiffnessSolver *stiffness = &((OstLinear *)path->analysis->work)->stiffness;
    OstNewton *newton = NULL;
    if (!stiffness->solver)
        OST_TRY(ost_stiffness_solver_make(stiffness));
    ost_problem_take_formulation(path->problem, path->problem->beyond_linear);
    OST_TRY(ost_newton_create(stiffness, &path->linear.solve, &newton));
    if (loads_turn(path, t))
        path->state.step = 0.0; /* the tangent gives another */
    OstStatus status =
        t > path->state.t ? ost_nonlinear_advance(newton, path->judged.linear_strain, t, &path->state) : OST_SUCCESS;
    int rests = 0;
    OST_THEN(come_to_rest(path, t, &rests));
    if (status == OST_SUCCESS || status == OST_NOT_CONVERGED) {
        result->newton = path->judged;
        const OstStatus filled = ost_newton_fill(newton, &path->state, result, solved_for);
        status = filled == OST_SUCCESS ? status : filled;
        if (rests)
            result->solve.error_estimate = result->solve.energy_error = 0.0;
    }
    ost_newton_destroy(&newton);
    return status;
}

static OstStatus step_by_newton(OstPath *path, double t, OstResult *result, OstSolvedFor *solved_for)
{
    OST_TRY(path->solved_linearly);
    ost_ledger_enter(path->ctx, OST_EFFECT_LARGE_ROTATION);
    OstStatus status = path->state.displacement ? OST_SUCCESS : begin(path, t, result);
    OST_THEN(run_newton(path, t, result, solved_for));
    ost_ledger_leave(path->ctx);
    return status;
}

static void record(const OstResult *result, double t, OstPathStep *step)
{
    *step = (OstPathStep){.t = t,
                          .largest_displacement = result->largest_displacement,
                          .strain_energy = result->checks.strain_energy,
                          .largest_strain = result->checks.largest_strain,
                          .largest_rotation = result->checks.largest_rotation,
                          .iterations = result->solve.iterations,
                          .newton_iterations = result->newton.iterations,
                          .load_steps = result->newton.load_steps,
                          .linear = result->checks.linear};
}

OstStatus ost_path_advance(OstPath *path, unsigned fields, OstResult **result)
{
    OstSolvedFor solved_for = {0};
    *result = NULL;
    if (path->done == path->count)
        return OST_RAISE(path->ctx, OST_INVALID_USAGE, "all %d steps of the path are done", path->count);
    const double t = path->times[path->done];
    OST_TRY(ost_result_create(path->problem, result));
    OST_TRY(solve_linearly(path));
    (*result)->unknowns = ost_problem_unknowns(path->problem);
    if (!path->decided)
        OST_TRY(decide(path, *result));
    (*result)->reached = 0; /* what was judged is no answer */
    const OstStatus solved =
        path->nonlinear ? step_by_newton(path, t, *result, &solved_for) : step_linearly(path, t, *result, &solved_for);
    if (!(*result)->reached)
        return solved;
    ost_result_take_outcome(*result, solved);
    if (!(*result)->unfinished)
        OST_TRY(solved);
    const double reached = path->nonlinear ? path->state.t : t;
    if (fields >> OST_FIELD_ERROR & 1U)
        OST_TRY(ost_analysis_estimate(path->analysis, reached, *result));
    OST_TRY(ost_analysis_conclude(path->analysis, reached, solved, &solved_for, fields, *result));
    record(*result, t, &path->steps[path->done++]);
    return OST_SUCCESS;
}

int ost_path_count(const OstPath *path)
{
    return path->count;
}

int ost_path_done(const OstPath *path)
{
    return path->done;
}

OstPathStep *ost_path_step(OstPath *path, int number)
{
    return &path->steps[number];
}

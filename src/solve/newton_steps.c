/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_seconds.h"
#include "assembly/links/levers.h"
#include "assembly/links/rigid_faces.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "guard/linearity.h"
#include "solve/linear.h"
#include "solve/motion/motion.h"
#include "solve/newton_data.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A first load step turns the body by about this much, in radians, as far as the tangent tells. */
static const double first_turn = 1.0;

/* Iterations: of a load step that may be cut back; of the least one; on the way from an unstable
 * state to a stable one; up to which the next step is twice as large, and
 * from which it is half as large. */
enum {
    MOST_ITERATIONS = 15,
    LAST_ITERATIONS = 60,
    SETTLING_ITERATIONS = 200,
    FEW_ITERATIONS = 6,
    MANY_ITERATIONS = 11
};

/* The least load step, as a share of what an advance is asked for. */
static const double least_step = 1.0 / 4096.0;

/* The classical form's stiffness lacks how R changes: its iterations converge linearly, and where a mode of it is stiff
 * only load steps so short come to rest. After so many in a row it would go on for hours. */
static const double short_step = 1.0 / 300.0;
enum { MOST_SHORT_STEPS = 20 };

/* Where the stiffness turned indefinite and the state found is farther from the predicted one than that is from the
 * last, the body jumps: the load step is cut back to this share of the advance, to tell where, and then taken. */
static const double jump_step = 1.0 / 16.0;

/* Where the stiffness does not tell (it has a skew part, or pressures), the tangent's prediction alone does: a body
 * that softens fast is followed by load steps of this share, one that jumps is not. A jump changes the displacement by
 * this much at the least. */
static const double jump_step_by_tangent = 1.0 / 64.0, least_jump = 1e-2;

/* Iterations with the definite stiffness go down the energy from one state at rest, no longer stable, to another. They
 * are many. A load step that is longer than that share is cut back after a few of them: most likely the body bends far
 * there, which shorter steps follow. */
enum { MOST_DESCENTS = 100, FEW_DESCENTS = 3 };

size_t ost_newton_state_size(const OstProblem *problem)
{
    return 3 * (size_t)problem->mesh->node_count + (problem->pressures ? (size_t)problem->pressures->count : 0) +
           (size_t)ost_turned_couplings_count(problem);
}

OstStatus ost_newton_state_create(const OstProblem *problem, OstNewtonState *state)
{
    const size_t count = ost_newton_state_size(problem);
    *state = (OstNewtonState){0};
    OstStatus status = OST_NEW(problem->ctx, &state->displacement, count);
    OST_THEN(OST_NEW(problem->ctx, &state->slope, count));
    return status;
}

void ost_newton_state_release(OstNewtonState *state)
{
    OST_FREE(state->displacement);
    OST_FREE(state->slope);
}

double ost_newton_first_step(double rotation)
{
    return rotation > first_turn ? first_turn / rotation : 1.0;
}

/* The rows of the stiffness, by the sums of their absolute values; nobody has moved the body yet. */
static OstStatus measure_stiffness(OstStiffnessSolver *stiffness)
{
    const OstBlockMatrix *matrix = stiffness->problem->system->matrix;
    double square = 0.0;
    if (stiffness->size > 0.0)
        return OST_SUCCESS;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        double sum[3] = {0.0}, room[9];
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
            const double *block = ost_block_matrix_block(matrix, row, k, room);
            for (int n = 0; n < 9; n++)
                sum[n / 3] += fabs(block[n]);
        }
        square += ost_dot3(sum, sum);
    }
    OST_TRY(ost_sum(matrix->ctx, 1, &square));
    stiffness->size = sqrt(square);
    return OST_SUCCESS;
}

OstStatus ost_newton_create(OstStiffnessSolver *stiffness, const OstSolveReport *solve, OstNewton **newton)
{
    OstProblem *problem = stiffness->problem;
    OstContext *ctx = problem->ctx;
    const size_t count = ost_newton_state_size(problem), owned = 3 * (size_t)problem->mesh->owned_nodes;
    const size_t rows =
        3 * (size_t)problem->system->matrix->rows + (problem->pressures ? ost_problem_pressure_room(problem) : 0);
    OstNewton *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        *made = (OstNewton){
            .ctx = ctx, .problem = problem, .options = stiffness->options, .stiffness = stiffness, .count = count};
        made->solve = *solve;
        made->method = solve->method;
        made->report.used = 1;
        made->report.setups = 1;
        OST_THEN(OST_NEW(ctx, &made->displacement, count));
        OST_THEN(OST_NEW(ctx, &made->candidate, count));
        OST_THEN(OST_NEW(ctx, &made->direction, count));
        OST_THEN(OST_NEW(ctx, &made->from, count));
        OST_THEN(OST_NEW(ctx, &made->trial.displacement, count));
        OST_THEN(OST_NEW(ctx, &made->trial.correction, rows));
        OST_THEN(OST_NEW(ctx, &made->internal, owned));
        OST_THEN(OST_NEW(ctx, &made->load, owned));
        OST_THEN(OST_NEW(ctx, &made->residual, rows));
        OST_THEN(OST_NEW(ctx, &made->correction, rows));
        if (problem->pressures)
            OST_THEN(OST_NEW(ctx, &made->of_tets, 4 * (size_t)problem->mesh->tet_count));
    }
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS && ost_turned_couplings_count(problem) > 0) {
        made->multipliers = ost_turned_couplings_count(problem);
        status = ost_turned_couplings_create(problem, rows, &made->couplings);
    }
    OST_THEN(measure_stiffness(stiffness));
    if (status != OST_SUCCESS)
        ost_newton_destroy(&made);
    else if (problem->pressures)
        ost_problem_take_pressure(problem, made->of_tets);
    *newton = made;
    return status;
}

void ost_newton_destroy(OstNewton **newton)
{
    if (!*newton)
        return;
    if ((*newton)->of_tets)
        ost_problem_take_pressure((*newton)->problem, NULL);
    ost_turned_couplings_destroy(&(*newton)->couplings);
    OST_FREE((*newton)->of_tets);
    OST_FREE((*newton)->displacement);
    OST_FREE((*newton)->candidate);
    OST_FREE((*newton)->direction);
    OST_FREE((*newton)->from);
    OST_FREE((*newton)->beyond);
    OST_FREE((*newton)->trial.displacement);
    OST_FREE((*newton)->trial.correction);
    OST_FREE((*newton)->internal);
    OST_FREE((*newton)->load);
    OST_FREE((*newton)->residual);
    OST_FREE((*newton)->correction);
    OST_FREE(*newton);
}

void ost_newton_stop_at(OstNewton *newton, double fraction, const OstAnswerError *answer, int watches_stress)
{
    newton->enough = fraction * answer->relative;
    newton->answer = *answer;
    newton->watches_stress = watches_stress;
}

void ost_newton_go_straight(OstNewton *newton)
{
    newton->leads_to_pose = 1;
}

/* Puts what is prescribed at the load factor into a displacement, ghosts included. */
static OstStatus prescribe(OstNewton *newton, double *displacement)
{
    return ost_problem_prescribe(newton->problem, newton->t, newton->correction, displacement);
}

/* Takes the method to a load factor: the load, and the residual that the state has under it. */
static OstStatus load_to(OstNewton *newton, const OstNewtonState *state, double t)
{
    newton->t = t;
    ost_problem_load(newton->problem, t, state->displacement, newton->load);
    OST_TRY(ost_newton_evaluate(newton, state->displacement));
    newton->driving = fmax(newton->driving, newton->driven);
    return OST_SUCCESS;
}

/* Subtracts from the residual P K dg, dg the change of the prescribed displacement (in `candidate`): K dg is the
 * derivative of the internal force, by a difference over a change of about 1e-7 of the body's size. */
static OstStatus move_supports(OstNewton *newton, const OstNewtonState *state)
{
    const OstProblem *problem = newton->problem;
    const OstMesh *mesh = problem->mesh;
    double low[3], high[3], largest = 0.0;
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes; i++)
        largest = fmax(largest, fabs(newton->candidate[i]));
    OST_TRY(ost_max(newton->ctx, 1, &largest));
    if (largest == 0.0)
        return OST_SUCCESS;
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    const double share = 1e-7 * fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]) / largest;
    for (size_t i = 0; i < newton->count; i++)
        newton->direction[i] = state->displacement[i] + share * newton->candidate[i];
    memcpy(newton->load, newton->internal, 3 * (size_t)mesh->owned_nodes * sizeof(double));
    OST_TRY(ost_agree(newton->ctx, ost_problem_force(problem, newton->t, newton->direction, newton->internal)));
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes; i++)
        newton->load[i] = (newton->internal[i] - newton->load[i]) / share;
    OST_TRY(ost_system_take_rows(problem->system, newton->load, newton->correction));
    for (size_t i = 0; i < 3 * (size_t)problem->system->matrix->rows; i++)
        newton->residual[i] -= newton->correction[i];
    return ost_newton_is_mixed(newton) ? ost_newton_move_volume(newton, newton->direction, share) : OST_SUCCESS;
}

/* Where the tangent at the state would take the body at load factor t: the state's slope. The first load step turns it
 * by `first_turn` at most. */
static OstStatus find_slope(OstNewton *newton, double t, OstNewtonState *state)
{
    const OstMesh *mesh = newton->problem->mesh;
    const size_t count = newton->count;
    OstLinearity largest;
    int found = 0;
    OST_TRY(load_to(newton, state, t));
    memcpy(newton->candidate, state->displacement, count * sizeof(double));
    OST_TRY(prescribe(newton, newton->candidate));
    memcpy(newton->displacement, newton->candidate, count * sizeof(double));
    for (size_t i = 0; i < count; i++)
        newton->candidate[i] -= state->displacement[i];
    OST_TRY(ost_rigid_faces_change(newton->problem->supports->links, state->displacement, newton->displacement, 0, 1.0,
                                   newton->candidate));
    OST_TRY(move_supports(newton, state));
    memcpy(newton->displacement, state->displacement, count * sizeof(double));
    newton->moved = 0;
    for (int definite = 0; definite < 2 && !found; definite++)
        OST_TRY(ost_newton_solve(newton, definite, 1e-3, newton->residual, &found));
    for (size_t i = 0; i < count; i++)
        newton->candidate[i] += found ? newton->direction[i] : 0.0;
    OST_TRY(
        ost_linearity_of(mesh, newton->problem->field, 0.0, newton->candidate, newton->problem->supports, &largest));
    for (size_t i = 0; i < count; i++)
        state->slope[i] = newton->candidate[i] / (t - state->t);
    state->step = (t - state->t) * ost_newton_first_step(largest.rotation);
    return OST_SUCCESS;
}

/* Does a definite stiffness not mean a stable state, or an indefinite one an unstable state? */
static int jumps_by_tangent(const OstNewton *newton)
{
    return ost_newton_is_unsymmetric(newton) || ost_newton_is_saddle(newton);
}

/* Where a state leads: the body turns on as a whole, and goes straight on beside that. */
static OstStatus predict(const OstNewton *newton, const OstNewtonState *state, double step, double *whole, double *to)
{
    OST_TRY(ost_newton_move(newton, state->displacement, state->slope, step, to));
    if (newton->leads_to_pose)
        return OST_SUCCESS;
    OST_TRY(ost_motion_predict(newton->problem->mesh, state->displacement, state->slope, step, whole, to));
    OST_TRY(ost_rigid_faces_move(newton->problem->supports->links, state->displacement, state->slope, step, to));
    return ost_levers_put(newton->problem->supports->links, to);
}

/* Is the state found farther from the predicted one than that was from the last? */
static OstStatus find_jump(OstNewton *newton, const OstNewtonState *state, double step, int *jumps)
{
    double sums[3] = {0.0};
    OST_TRY(predict(newton, state, step, NULL, newton->candidate));
    for (size_t i = 0; i < 3 * (size_t)newton->problem->mesh->owned_nodes; i++) {
        const double predicted = newton->candidate[i] - state->displacement[i];
        const double missed = newton->displacement[i] - state->displacement[i] - predicted;
        sums[0] += missed * missed;
        sums[1] += predicted * predicted;
        sums[2] += newton->displacement[i] * newton->displacement[i];
    }
    OST_TRY(ost_sum(newton->ctx, 3, sums));
    const int is_seen = jumps_by_tangent(newton) ? sums[0] > least_jump * least_jump * sums[2] : newton->indefinite;
    *jumps = is_seen && sums[0] > sums[1];
    return OST_SUCCESS;
}

/* Is a state at rest known that lies beyond a jump? */
static int has_beyond(const OstNewton *newton, const OstNewtonState *state)
{
    return newton->beyond && newton->beyond_t > state->t;
}

static OstStatus keep_beyond(OstNewton *newton, const OstNewtonState *state)
{
    if (has_beyond(newton, state) && newton->beyond_t < newton->t)
        return OST_SUCCESS;
    if (!newton->beyond)
        OST_TRY(ost_agree(newton->ctx, OST_NEW(newton->ctx, &newton->beyond, newton->count)));
    memcpy(newton->beyond, newton->displacement, newton->count * sizeof(double));
    newton->beyond_t = newton->t;
    newton->beyond_change = newton->change;
    return OST_SUCCESS;
}

/* Where no shorter load step leads on, the body has jumped there. */
static OstStatus go_beyond(OstNewton *newton, const OstNewtonState *state)
{
    OST_TRY(load_to(newton, state, newton->beyond_t));
    memcpy(newton->displacement, newton->beyond, newton->count * sizeof(double));
    newton->change = newton->beyond_change;
    return ost_newton_evaluate(newton, newton->displacement);
}

/* The next attempt has half the load step. What looks like a jump may come of a prediction along the last two states.
 */
static OstStatus cut_back(OstNewton *newton, double step, int jumps, OstNewtonState *state)
{
    newton->report.cut_backs++;
    if (jumps && jumps_by_tangent(newton)) {
        OST_TRY(keep_beyond(newton, state));
        OST_TRY(find_slope(newton, state->t + step, state));
    }
    state->step = 0.5 * step;
    return OST_SUCCESS;
}

/* One load step; `rest` says how it ended. */
static OstStatus try_step(OstNewton *newton, const OstNewtonState *state, double t, int most_iterations, OstRest *rest)
{
    const double step = t - state->t;
    newton->indefinite = newton->step_iterations = 0;
    OST_TRY(load_to(newton, state, t));
    newton->moved = 1;
    memcpy(newton->from, state->displacement, newton->count * sizeof(double));
    OST_TRY(predict(newton, state, step, newton->from, newton->displacement));
    OST_TRY(prescribe(newton, newton->displacement));
    return ost_newton_find_rest(newton, most_iterations, rest);
}

static int is_at_rest(const OstNewton *newton, OstRest rest)
{
    return rest == OST_REST_FOUND || (rest == OST_REST_ROUNDING && newton->options.accept_attainable);
}

static int factors_spare_corrections(const OstNewton *newton)
{
    return newton->options.method == OST_METHOD_AUTO && !ost_newton_is_saddle(newton) &&
           ost_solver_factors_spare_corrections(&newton->stiffness->facts);
}

/* The hierarchy of the stiffness at u = 0 serves a body that begins there. */
static OstStatus renew_hierarchy(OstNewton *newton, const OstNewtonState *state)
{
    double largest = 0.0;
    for (size_t i = 0; i < 3 * (size_t)newton->problem->mesh->owned_nodes; i++)
        largest = fmax(largest, fabs(state->displacement[i]));
    OST_TRY(ost_max(newton->ctx, 1, &largest));
    newton->rebuild = newton->stiffness->moved || largest > 0.0;
    if (newton->rebuild)
        newton->method = OST_METHOD_AUTO;
    if (factors_spare_corrections(newton)) {
        newton->rebuild = 1;
        newton->method = OST_METHOD_DIRECT;
    }
    if (!newton->rebuild || !ost_newton_is_mixed(newton))
        return OST_SUCCESS;
    ost_newton_take_pressure(newton, state->displacement); /* by whose stiffness and coupling residuals are measured */
    return ost_problem_stiffness_from(newton->problem, state->t, state->displacement, NULL, 0);
}

/* The end of an advance: a stable state. Where the search for it has stopped too early, it goes on. */
static OstStatus come_to_rest(OstNewton *newton, OstRest *rest)
{
    enum { ROUNDS = 3 };
    for (int round = 1;; round++) {
        OST_TRY(ost_newton_settle(newton, SETTLING_ITERATIONS, rest));
        if (!is_at_rest(newton, *rest))
            return OST_SUCCESS;
        OST_TRY(ost_newton_find_errors(newton));
        const double beyond =
            newton->stopped ? ost_stop_excess(&newton->errors, &newton->answer, newton->watches_stress) : 0.0;
        if (beyond <= 1.0)
            return OST_SUCCESS;
        newton->enough = round < ROUNDS ? 0.5 / beyond * newton->enough : 0.0;
        OST_TRY(ost_newton_find_rest(newton, SETTLING_ITERATIONS, rest));
        if (!is_at_rest(newton, *rest))
            return OST_SUCCESS;
    }
}

/* A load step that was tried, and how it ended. */
typedef struct Attempt {
    double t; /* to which load factor */
    OstRest rest;
    int found, jumps;
    int is_shortest; /* short enough that a jump is accepted? */
} Attempt;

static OstStatus attempt_step(OstNewton *newton, const OstNewtonState *state, int most_iterations, Attempt *attempt)
{
    const double step = attempt->t - state->t;
    OST_TRY(try_step(newton, state, attempt->t, most_iterations, &attempt->rest));
    attempt->found = is_at_rest(newton, attempt->rest);
    if (attempt->found)
        return find_jump(newton, state, step, &attempt->jumps);
    if (!attempt->is_shortest || !has_beyond(newton, state))
        return OST_SUCCESS;
    OST_TRY(go_beyond(newton, state));
    *attempt = (Attempt){.t = newton->t, .rest = OST_REST_FOUND, .found = 1, .jumps = 1, .is_shortest = 1};
    return OST_SUCCESS;
}

static void tell(const OstNewton *newton, const OstNewtonState *state, const Attempt *attempt)
{
    const char *end = !attempt->found ? "given up" : attempt->jumps ? "the body jumps" : "at rest";
    ost_log(newton->ctx, OST_LOG_VERBOSE, "newton: load step from %.6g to %.6g: %s after %d iterations", state->t,
            attempt->t, end, newton->step_iterations);
}

/* Beyond a jump, the next prediction has nothing of it. */
static OstStatus accept(OstNewton *newton, const Attempt *attempt, double to, OstNewtonState *state)
{
    const double step = attempt->t - state->t;
    const size_t count = newton->count;
    for (size_t i = 0; i < count; i++)
        state->slope[i] = (newton->displacement[i] - state->displacement[i]) / step;
    OST_TRY(ost_motion_slope(newton->problem->mesh, state->displacement, newton->displacement, step, state->slope));
    newton->leads_to_pose = 0;
    OST_TRY(ost_rigid_faces_change(newton->problem->supports->links, state->displacement, newton->displacement, 1, step,
                                   state->slope));
    memcpy(state->displacement, newton->displacement, count * sizeof(double));
    state->t = attempt->t;
    state->step = newton->step_iterations <= FEW_ITERATIONS    ? 2.0 * step
                  : newton->step_iterations >= MANY_ITERATIONS ? 0.5 * step
                                                               : step;
    newton->report.load_steps++;
    newton->report.reached = attempt->t;
    newton->report.relative_residual = newton->norm / newton->size;
    newton->report.change = newton->change;
    newton->report.jumps += attempt->jumps;
    newton->report.jump_at = attempt->jumps ? attempt->t : newton->report.jump_at;
    newton->report.rounding_limited |= attempt->rest == OST_REST_ROUNDING;
    ost_progress(newton->ctx, "load", state->t);
    return attempt->jumps && jumps_by_tangent(newton) && attempt->t < to ? find_slope(newton, to, state) : OST_SUCCESS;
}

/* Has the classical form come to rest after short load steps alone? */
static int creeps(const OstNewton *newton, double share, int *steps)
{
    *steps = share < short_step && newton->problem->formulation == OST_FORMULATION_CLASSICAL ? *steps + 1 : 0;
    return *steps >= MOST_SHORT_STEPS;
}

static OstStatus advance(OstNewton *newton, double to, OstNewtonState *state)
{
    int short_steps = 0;
    const double span = to - state->t;
    const double longest = newton->options.load_steps > 0 ? span / newton->options.load_steps : span;
    const double least_jump_step = jumps_by_tangent(newton) ? jump_step_by_tangent : jump_step;
    int follows = ost_newton_has_energy(newton) && !ost_newton_is_saddle(newton); /* by short steps, if need be */
    OST_TRY(renew_hierarchy(newton, state));
    if (!(state->step > 0.0))
        OST_TRY(find_slope(newton, to, state));
    while (state->t < to) {
        const double left = to - state->t;
        const double steps = fmax(ceil(left / fmin(state->step, longest) - 1e-6), 1.0);
        const double step = left / steps;
        const int may_cut = step > least_step * span;
        Attempt attempt = {.t = steps > 1.0 ? state->t + step : to, .is_shortest = step <= least_jump_step * span};
        newton->most_descents = follows && step > jump_step * span ? FEW_DESCENTS : MOST_DESCENTS;
        OST_TRY(attempt_step(newton, state, may_cut ? MOST_ITERATIONS : LAST_ITERATIONS, &attempt));
        newton->most_descents = MOST_DESCENTS;
        const int accepted = attempt.found && (attempt.is_shortest || !attempt.jumps);
        if (accepted && attempt.t == to)
            OST_TRY(come_to_rest(newton, &attempt.rest));
        if (accepted && !is_at_rest(newton, attempt.rest))
            return ost_newton_give_up(newton, state, attempt.t, attempt.rest);
        tell(newton, state, &attempt);
        if (accepted) {
            OST_TRY(accept(newton, &attempt, to, state));
            if (state->t < to && creeps(newton, step / span, &short_steps))
                return ost_newton_give_up(newton, state, state->t + step, OST_REST_CREEPS);
            continue;
        }
        if (!may_cut && !follows)
            return ost_newton_give_up(newton, state, attempt.t, attempt.rest);
        if (!may_cut) { /* the path turns back here: down to another state at rest, in a long step */
            follows = 0;
            state->step = left;
            continue;
        }
        OST_TRY(cut_back(newton, step, attempt.jumps, state));
    }
    return OST_SUCCESS;
}

OstStatus ost_newton_advance(OstNewton *newton, double to, OstNewtonState *state)
{
    const double start = ost_seconds();
    const OstStatus status = advance(newton, to, state);
    newton->report.seconds += ost_seconds() - start;
    ost_progress(newton->ctx, "load", -1.0);
    return status;
}

/* The plan is that of the linear solve. */
static void state_plan(const OstNewton *newton, OstSolverPlan *plan)
{
    const OstSolverFacts *facts = &newton->stiffness->facts;
    if (newton->method != OST_METHOD_DIRECT || !factors_spare_corrections(newton))
        return;
    plan->first = OST_METHOD_DIRECT;
    plan->reasons = 1;
    snprintf(plan->reason[0], sizeof plan->reason[0],
             "%.3g nodes across: by factors, about %.2g s each, Newton's method takes fewer and longer steps",
             facts->thickness, ost_solver_factor_seconds(facts));
}

/* Where nothing better is known, the error of the displacement is about that of the next correction: the square of the
 * last, or what its linear solve left of it. */
OstStatus ost_newton_fill(OstNewton *newton, const OstNewtonState *state, OstResult *result, OstSolvedFor *solved_for)
{
    OST_TRY(load_to(newton, state, state->t));
    memcpy(result->displacement, state->displacement, 3 * (size_t)result->mesh->node_count * sizeof(double));
    if (newton->couplings)
        OST_TRY(ost_turned_couplings_apply(newton->couplings, state->t));
    if (newton->of_tets)
        memcpy(result->pressure, newton->of_tets, 4 * (size_t)result->mesh->tet_count * sizeof(double));
    newton->report.relative_residual = newton->norm / newton->size;
    const OstNewtonReport before = result->newton;
    result->newton = newton->report;
    result->newton.judged = before.judged;
    result->newton.linear_error = before.linear_error;
    result->newton.accuracy = before.accuracy;
    result->newton.linear_strain = before.linear_strain;
    result->newton.linear_rotation = before.linear_rotation;
    result->newton.linear_stiffening = before.linear_stiffening;
    result->newton.linear_change = before.linear_change;
    result->solve = newton->solve;
    state_plan(newton, &result->solve.plan);
    result->solve.iterations = newton->report.linear_iterations;
    result->solve.relative_residual = newton->report.relative_residual;
    result->solve.rounding_limited = newton->report.rounding_limited;
    result->solve.stopped = newton->stopped;
    result->solve.iterations_saved = 0;
    result->solve.algebraic_bound = 0.0;
    result->solve.algebraic_error = newton->stopped ? newton->decrement * fmax(newton->change, newton->forcing) : 0.0;
    /* A linear solve that stops early may leave more of the softest modes than its residual shows. */
    const double caution = newton->stopped ? 10.0 : 1.0;
    result->solve.error_estimate = caution * newton->change * fmax(newton->change, newton->forcing);
    result->solve.energy_error = result->solve.error_estimate;
    result->solve.rounding_error = result->solve.rounding_spread = 0.0;
    result->reached = 1;
    *solved_for = (OstSolvedFor){.norm = newton->size, .errors = newton->errors};
    return OST_SUCCESS;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/stop.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "guard/linearity.h"
#include "solve/buckling/buckling.h"
#include "solve/left_out/left_out.h"
#include "solve/linear.h"
#include "solve/newton_data.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Large rotations: first the linear solve, which costs little, tells how much the body turns, and is the first
 * prediction; then, where that is asked for or linear theory is too far off, Newton's method. */

static OstStatus prepare(OstAnalysis *analysis, OstVerdict *before)
{
    ost_problem_take_formulation(analysis->problem, OST_FORMULATION_LINEAR);
    OST_TRY(ost_problem_turn(analysis->problem, NULL));
    if (analysis->work && !analysis->problem->filled) /* an earlier solve has filled the matrix elsewhere */
        ost_linear_strategy.release(analysis);
    return ost_linear_strategy.prepare(analysis, before);
}

/* Solids do not strain so far; numbers in units that do not fit each other often do. */
static const double odd_strain = 10.0;

static void ask_for_units(double strain, size_t size, char *text)
{
    snprintf(text, size,
             "by linear theory the body strains by up to %.3g %%: do all numbers have the units of one set, as m, N, "
             "Pa, kg/m3, m/s2, or mm, N, MPa, t/mm3, mm/s2 (1 GPa = 1e9 Pa = 1e3 MPa; 1 kg/m3 = 1e-12 t/mm3)?",
             100.0 * strain);
}

OstStatus ost_nonlinear_judge(const OstProblem *problem, OstResult *result)
{
    OstLinearity largest;
    ost_ledger_enter(problem->ctx, OST_EFFECT_LARGE_ROTATION);
    const OstStatus status = ost_linearity_of(problem->mesh, result->field, ost_problem_eigen_share(problem, result->t),
                                              result->displacement, problem->supports, &largest);
    ost_ledger_leave(problem->ctx);
    OST_TRY(status);
    const OstChecks as_linear = {.largest_strain = largest.strain,
                                 .largest_rotation = largest.rotation,
                                 .stiffening = ost_linearity_stiffening(&largest)};
    result->newton.judged = 1;
    result->newton.linear_strain = largest.strain;
    result->newton.linear_rotation = largest.rotation;
    result->newton.linear_stiffening = as_linear.stiffening;
    result->newton.linear_error = ost_linear_error(&as_linear);
    result->newton.accuracy = problem->accuracy;
    ost_log(
        problem->ctx, OST_LOG_VERBOSE,
        "large rotation: by linear theory, rotations up to %.3g, strains up to %.3g, stiffened by %.3g: off by about "
        "%.2g (asked: %.2g)",
        largest.rotation, largest.strain, as_linear.stiffening, result->newton.linear_error, problem->accuracy);
    if (largest.strain > odd_strain) {
        char question[300];
        ask_for_units(largest.strain, sizeof question, question);
        ost_warn(problem->ctx, "%s", question);
    }
    return OST_SUCCESS;
}

/* The warning may not have been shown, and what comes of odd units says nothing of them. */
OstStatus ost_nonlinear_advance(OstNewton *newton, double linear_strain, double to, OstNewtonState *state)
{
    const OstStatus status = ost_newton_advance(newton, to, state);
    char reason[OST_ERROR_TEXT_SIZE], question[300];
    if (status != OST_NOT_CONVERGED || !(linear_strain > odd_strain))
        return status;
    snprintf(reason, sizeof reason, "%s", ost_error_text(newton->ctx));
    ask_for_units(linear_strain, sizeof question, question);
    return OST_RAISE(newton->ctx, status, "%s; %s", reason, question);
}

int ost_nonlinear_stays_linear(const OstProblem *problem, double linear_error)
{
    return problem->automatic && linear_error <= problem->accuracy;
}

int ost_nonlinear_may_be_mixed(const OstProblem *problem)
{
    return problem->beyond_linear != OST_FORMULATION_CLASSICAL;
}

/* Is a pose known that a load step can go to at once? A rigid face goes along its rotation, which a pose does not
 * tell; and it has neither pressures nor the forces of moved couplings. */
static int has_pose(const OstAnalysis *analysis)
{
    const OstProblem *problem = analysis->problem;
    return analysis->pose && !problem->pressures && !ost_problem_has_turning(problem) &&
           !ost_turned_couplings_count(problem);
}

/* The state without load, and what the linear solution predicts, or the answer on a coarser mesh. */
static OstStatus start(const OstAnalysis *analysis, const OstResult *result, OstNewtonState *state)
{
    const OstProblem *problem = analysis->problem;
    const OstLinear *linear = analysis->work;
    const size_t nodes = 3 * (size_t)problem->mesh->node_count;
    OST_TRY(ost_agree(problem->ctx, ost_newton_state_create(problem, state)));
    memcpy(state->slope, result->displacement, nodes * sizeof(double));
    if (problem->pressures) {
        memcpy(state->slope + nodes, linear->pressure, (size_t)problem->pressures->owned * sizeof(double));
        OST_TRY(ost_pressure_complete(problem->pressures, state->slope + nodes));
    }
    ost_turned_couplings_begin(problem, 1.0,
                               state->slope + ost_newton_state_size(problem) - ost_turned_couplings_count(problem));
    state->step = ost_newton_first_step(result->newton.linear_rotation);
    if (has_pose(analysis)) {
        memcpy(state->slope, analysis->pose, nodes * sizeof(double));
        state->step = 1.0;
    }
    return OST_SUCCESS;
}

/* The classical formulation has no mixed form: Newton's method goes on with the mean dilatation, and a solver of that
 * stiffness. */
static OstStatus leave_mixed(OstAnalysis *analysis, OstResult *result)
{
    OstProblem *problem = analysis->problem;
    OstVerdict before = {.count = 0};
    ost_linear_strategy.release(analysis);
    OST_TRY(ost_problem_leave_mixed(problem));
    OST_FREE(result->pressure);
    result->at_pressure = *problem->field;
    OST_TRY(ost_linear_strategy.prepare(analysis, &before));
    OST_TRY(ost_verdict_raise(analysis->ctx, &before));
    return ost_stiffness_solver_make(&((OstLinear *)analysis->work)->stiffness);
}

/* The unfolded stiffness is the largest array that Newton's method adds: where it does not fit, that is said at once.
 */
static OstStatus unfold(OstProblem *problem)
{
    const OstBlockMatrix *matrix = problem->system->matrix;
    const OstLocal blocks = matrix->upper ? matrix->row_start[matrix->rows] : 0;
    OST_TRY(
        ost_memory_foresee(problem->ctx, 9.0 * sizeof(double) * (double)blocks, "the stiffness for large rotations"));
    return ost_problem_unfold_stiffness(problem);
}

static OstStatus go_on(OstAnalysis *analysis, OstResult *result, OstSolvedFor *solved_for)
{
    OstProblem *problem = analysis->problem;
    if (problem->pressures && !ost_nonlinear_may_be_mixed(problem))
        OST_TRY(leave_mixed(analysis, result));
    OstLinear *linear = analysis->work;
    OstNewton *newton = NULL;
    OstNewtonState state = {0};
    OST_FREE(result->internal); /* by linear theory */
    ost_problem_take_formulation(problem, problem->beyond_linear);
    OST_TRY(unfold(problem));
    ost_ledger_enter(problem->ctx, OST_EFFECT_LARGE_ROTATION);
    OstStatus status = start(analysis, result, &state);
    OST_THEN(ost_newton_create(&linear->stiffness, &result->solve, &newton));
    if (status == OST_SUCCESS && has_pose(analysis))
        ost_newton_go_straight(newton);
    if (status == OST_SUCCESS && result->answer.known && ost_reactions_allow_stop(problem))
        ost_newton_stop_at(newton, ost_stop_share(problem, analysis->options.algebraic_fraction, &result->answer),
                           &result->answer, result->stress_surplus || result->node_stress_surplus);
    result->answer = (OstAnswerError){0}; /* that of the linear answer */
    if (status == OST_SUCCESS) {
        status = ost_nonlinear_advance(newton, result->newton.linear_strain, 1.0, &state);
        if (status == OST_SUCCESS || status == OST_NOT_CONVERGED) {
            OstStatus filled = ost_newton_fill(newton, &state, result, solved_for);
            if (filled == OST_SUCCESS && ost_turned_couplings_count(problem) > 0)
                filled = ost_analysis_take_loading(analysis);
            status = filled == OST_SUCCESS ? status : filled;
        }
    }
    ost_newton_destroy(&newton);
    ost_newton_state_release(&state);
    ost_ledger_leave(problem->ctx);
    return status;
}

/* Adds to the failure that there is no room for large rotations what the case could ask for instead. */
static OstStatus name_linear(OstContext *ctx, double linear_error)
{
    char reason[1024];
    snprintf(reason, sizeof reason, "%s", ost_error_text(ctx));
    return OST_RAISE(ctx, OST_OUT_OF_MEMORY, "%s; 'large_rotation: off' takes less and is off by about %.2g %%", reason,
                     100.0 * linear_error);
}

OstStatus ost_nonlinear_look_closer(const OstAnalysis *analysis, OstResult *result)
{
    OstLinear *linear = analysis->work;
    ost_ledger_enter(analysis->ctx, OST_EFFECT_LARGE_ROTATION);
    OstStatus status = OST_SUCCESS;
    if (!linear->stiffness.solver)
        status = ost_stiffness_solver_make(&linear->stiffness);
    OST_THEN(ost_left_out_find(analysis->problem, linear->stiffness.solver, result));
    if (result->newton.linear_error <= analysis->problem->accuracy)
        OST_THEN(ost_buckling_judge(analysis->problem, linear->stiffness.solver, result));
    ost_ledger_leave(analysis->ctx);
    return status;
}

static OstStatus solve(OstAnalysis *analysis, OstResult *result, OstSolvedFor *solved_for)
{
    const OstProblem *problem = analysis->problem;
    OST_TRY(ost_linear_strategy.solve(analysis, result, solved_for));
    OST_TRY(ost_analysis_find_buckling(analysis, result));
    OST_TRY(ost_nonlinear_judge(problem, result));
    if (problem->automatic && result->newton.linear_error <= problem->accuracy)
        OST_TRY(ost_nonlinear_look_closer(analysis, result));
    if (ost_nonlinear_stays_linear(problem, result->newton.linear_error))
        return OST_SUCCESS;
    if (problem->automatic && ost_buckling_ends(result))
        return OST_SUCCESS;
    if (analysis->company)
        return OST_RAISE(analysis->ctx, OST_NOT_CONVERGED, "rotations are too large to be solved for in company");
    const double linear_error = result->newton.linear_error;
    const OstStatus status = go_on(analysis, result, solved_for);
    return status == OST_OUT_OF_MEMORY && problem->automatic ? name_linear(analysis->ctx, linear_error) : status;
}

static void release(OstAnalysis *analysis)
{
    ost_linear_strategy.release(analysis);
}

const OstStrategy ost_nonlinear_strategy = {.prepare = prepare, .solve = solve, .release = release};

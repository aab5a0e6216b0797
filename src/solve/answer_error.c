/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "solve/distributing/distributing.h"
#include "solve/linear.h"

#include <math.h>
#include <string.h>

/* Few steps have little of the error of a displacement that multigrid finds slowly, and further ones are taken where
 * something is watched alone: 0.22 to 0.67 of it in thin walls of quadratic tets, whose condition is 4 to 80 after
 * preconditioning; 0.75 to 1.11 in bodies where that is below 2.7. (A mixed form's condition is that of both
 * equations.)
 */
static const double slow = 3.0;

/* Where the error is: the region with the largest share of its square, and the tet. `share` has a number for each
 * region; tet_error still has squares. */
static OstStatus find_worst(const OstResult *result, double *share, OstAnswerError *answer)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    const int regions = mesh->regions.count;
    struct {
        double value;
        int rank;
    } most = {-1.0, ost_rank(ctx)};
    OstLocal worst = -1;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        share[mesh->tet_region[tet]] += result->tet_error[tet];
        if (!(result->tet_error[tet] > most.value))
            continue;
        most.value = result->tet_error[tet];
        worst = tet;
    }
    OST_TRY(ost_sum(ctx, regions, share));
    for (int r = 1; r < regions; r++)
        if (share[r] > share[answer->region])
            answer->region = r;
    const double square = answer->energy_norm * answer->energy_norm;
    answer->region_share = square > 0.0 ? share[answer->region] / square : 0.0;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ost_comm(ctx))));
    for (int a = 0; a < 4 && worst >= 0; a++)
        for (int i = 0; i < 3; i++)
            answer->place[i] += 0.25 * mesh->coordinates[3 * (size_t)ost_mesh_nodes_of(mesh, worst)[a] + (size_t)i];
    return OST_MPI(ctx, MPI_Bcast(answer->place, 3, MPI_DOUBLE, most.rank, ost_comm(ctx)));
}

/* Is a stress watched that the estimate knows: a mean one, or one at a place? */
static int watches_stress(const OstProblem *problem, int is_mean)
{
    int any = 0;
    for (int w = 0; problem->scene && w < problem->scene->c->watch_count; w++) {
        const OstWatch *watch = &problem->scene->c->watches[w];
        any |= ost_watch_is_of_stress(watch) && (watch->region && watch->take == OST_TAKE_MEAN) == is_mean;
    }
    return any;
}

/* Is a mean stress watched along axes that vary within tets? */
static int watches_varying_axes(const OstProblem *problem)
{
    int any = 0;
    for (int w = 0; problem->scene && w < problem->scene->c->watch_count; w++) {
        const OstWatch *watch = &problem->scene->c->watches[w];
        any |= ost_watch_is_linear_mean(watch) && watch->component >= (int)OST_STRESS_MEASURE_11 &&
               watch->component <= (int)OST_STRESS_MEASURE_31;
    }
    return any && problem->mesh->nodes_per_tet == 10 &&
           (problem->field->region_formula || problem->field->tet_directions);
}

OstStatus ost_result_allow_error(const OstProblem *problem, OstResult *result)
{
    const OstMesh *mesh = result->mesh;
    const int is_watched = problem->scene && problem->scene->c->watch_count > 0;
    OstStatus status = OST_SUCCESS;
    if (!result->tet_error)
        status = OST_NEW(result->ctx, &result->tet_error, mesh->owned_tets);
    if (is_watched && !result->surplus)
        OST_THEN(OST_NEW(result->ctx, &result->surplus, 3 * (size_t)mesh->node_count));
    if (watches_stress(problem, 1) && !result->stress_surplus)
        OST_THEN(OST_NEW(result->ctx, &result->stress_surplus, 6 * (size_t)mesh->owned_tets));
    if (watches_varying_axes(problem) && !result->along_axes_surplus)
        OST_THEN(OST_NEW(result->ctx, &result->along_axes_surplus, 6 * (size_t)mesh->owned_tets));
    if (watches_stress(problem, 0) && !result->node_stress_surplus)
        OST_THEN(OST_NEW(result->ctx, &result->node_stress_surplus,
                         6 * (size_t)mesh->nodes_per_tet * (size_t)mesh->tet_count));
    return ost_agree(result->ctx, status);
}

OstSurplus ost_result_surplus(const OstResult *result)
{
    return (OstSurplus){result->tet_error, result->surplus, result->stress_surplus, result->along_axes_surplus,
                        result->node_stress_surplus};
}

static int asks_of_quantity(const OstProblem *problem)
{
    return problem->scene && problem->scene->c->interest > 0;
}

/* With the answer's pressure, if it has one: forces and energies of a mixed form have a part in it. */
static OstProblem at_answer(const OstAnalysis *analysis, const OstResult *result)
{
    OstProblem state = *analysis->problem;
    state.field = result->field;
    return state;
}

static int finds_reactions(const OstAnalysis *analysis)
{
    return !analysis->leaves_reactions && ost_reactions_have_adjoint(analysis->problem);
}

/* Fills the stiffness at the answer, not that of the last correction, and brings the solver up to date with it; or that
 * of linear theory, which turns with the tets. */
static OstStatus move_stiffness(OstAnalysis *analysis, double t, const OstResult *result, int as_linear,
                                OstSolverUpdate how)
{
    OstProblem *problem = analysis->problem;
    OstStiffnessSolver *stiffness = &((OstLinear *)analysis->work)->stiffness;
    const OstFormulation formulation = problem->formulation;
    const double *pressure = problem->field->pressure;
    const int definite = as_linear && problem->pressures;
    ost_problem_take_formulation(problem, as_linear && !problem->pressures ? OST_FORMULATION_CLASSICAL
                                                                           : OST_FORMULATION_CONSISTENT);
    if (problem->pressures)
        ost_problem_take_pressure(problem, result->pressure);
    OstStatus status = ost_problem_stiffness_from(problem, t, result->displacement, NULL, definite);
    stiffness->moved = 1;
    ost_solver_aim(
        stiffness->solver, /* not that of Newton's method, which ends where others may do */
        (OstSolverAim){.first = result->solve.method, .coupling = problem->pressures ? problem->coupling : NULL});
    OST_THEN(how == OST_UPDATE_KEEP ? ost_solver_update(stiffness->solver, how)
                                    : ost_stiffness_solver_rebuild(stiffness, t, result->displacement));
    if (problem->pressures)
        ost_problem_take_pressure(problem, pressure);
    ost_problem_take_formulation(problem, formulation);
    return ost_adjoint_has_no_answer(status) ? OST_SUCCESS : status;
}

/* Adjoint problems of large rotations need the stiffness at the answer. The solver's hierarchy does for it, mostly; a
 * solve that finds it too old ends. */
static OstStatus move_for_adjoints(OstAnalysis *analysis, double t, const OstResult *result)
{
    const OstProblem *problem = analysis->problem;
    if (ost_problem_is_linear(problem) || !(asks_of_quantity(problem) || finds_reactions(analysis)))
        return OST_SUCCESS;
    return move_stiffness(analysis, t, result, 0, OST_UPDATE_KEEP);
}

/* A new hierarchy, with which the solver may go on to its other strategies, for an adjoint problem that the old one did
 * not solve. */
static OstStatus renew_for_adjoints(OstAnalysis *analysis, double t, const OstResult *result, int *renewed)
{
    *renewed = !ost_problem_is_linear(analysis->problem);
    return *renewed ? move_stiffness(analysis, t, result, 0, OST_UPDATE_REBUILD) : OST_SUCCESS;
}

/* The quantity's error, by its adjoint problem; NAN if that has no answer. */
static OstStatus solve_interest(OstAnalysis *analysis, OstEstimate *estimate, double t, const OstInterest *interest,
                                OstResult *result)
{
    const OstLinear *linear = analysis->work;
    const int is_linear = ost_problem_is_linear(analysis->problem);
    const double share = is_linear ? ost_share_of_adjoint(result->answer.relative) : 0.0;
    OstInterestError *found = &result->interest;
    int renewed = 0;
    OstStatus status = ost_estimate_interest(estimate, linear->stiffness.solver, t, result->displacement, interest,
                                             share, &found->error, found->share);
    if (ost_adjoint_has_no_answer(status)) {
        OST_TRY(renew_for_adjoints(analysis, t, result, &renewed));
        if (renewed)
            status = ost_estimate_interest(estimate, linear->stiffness.solver, t, result->displacement, interest, share,
                                           &found->error, found->share);
    }
    found->has_no_answer = ost_adjoint_has_no_answer(status);
    if (found->has_no_answer)
        ost_warn(analysis->ctx,
                 "the error of what 'of' names is not known, as its adjoint problem could not be solved (%.300s): that "
                 "in the norm of the energy is taken in its place",
                 ost_error_text(analysis->ctx));
    return found->has_no_answer ? OST_SUCCESS : status;
}

/* The error of the quantity that the case asks about; tet_error still has squares. That of a strain energy is half the
 * squared error in the norm of the energy. The mesh makes none of a reaction that statics gives. */
static OstStatus estimate_interest(OstAnalysis *analysis, OstEstimate *estimate, double t, OstResult *result)
{
    const OstProblem state = at_answer(analysis, result);
    const OstWatch *watch = &state.scene->c->watches[state.scene->c->interest - 1];
    OstInterestError *found = &result->interest;
    OstWatchedReaction by_statics = {0};
    OST_TRY(ost_reactions_by_statics(&state, watch, t, result->displacement, &by_statics));
    OST_TRY(ost_agree(result->ctx, OST_NEW(result->ctx, &found->share, result->mesh->owned_tets)));
    const double part = by_statics.known ? 0.0 : watch->kind == OST_WATCH_STRAIN_ENERGY ? 0.5 : 1.0;
    for (OstLocal tet = 0; tet < result->mesh->owned_tets; tet++)
        found->share[tet] = part * result->tet_error[tet];
    if (watch->kind == OST_WATCH_STRAIN_ENERGY) {
        OST_TRY(ost_problem_energy(&state, t, result->displacement, &found->value));
        found->error = 0.5 * result->answer.energy_norm * result->answer.energy_norm;
    } else {
        OstInterest interest;
        OstStatus status = ost_interest_create(&state, watch, t, result->displacement, &interest);
        interest.stopped = watch->kind == OST_WATCH_DISPLACEMENT && result->solve.stopped;
        if (status == OST_SUCCESS && !by_statics.known)
            status = solve_interest(analysis, estimate, t, &interest, result);
        found->value = interest.value;
        found->doubt = interest.moved && ost_estimate_misses(estimate) ? fabs(found->error) : interest.doubt;
        found->size = interest.size;
        ost_interest_clear(&interest);
        OST_TRY(status);
    }
    for (OstLocal tet = 0; tet < result->mesh->owned_tets; tet++)
        found->sum += found->share[tet];
    OST_TRY(ost_sum(result->ctx, 1, &found->sum));
    const int has_none =
        watch->kind == OST_WATCH_REACTION && !by_statics.known && !ost_reactions_have_adjoint(analysis->problem);
    found->watch = isnan(found->error) || has_none ? NULL : watch;
    return OST_SUCCESS;
}

/* A hierarchy, or factors that GMRES was content with, made before the body turned see its bending as strain: few steps
 * would then find a fifth to two fifths of a watched displacement's error. Where the exact stiffness was indefinite on
 * the way, tets that cannot turn without strain are stressed so far in stiff directions that it is far above that of
 * the error: 5000 times too little was found in an L of fibres 1e5 times stiffer along than across. */
static OstStatus renew_solver(OstAnalysis *analysis, double t, const OstResult *result)
{
    const OstProblem *problem = analysis->problem;
    const OstSolveReport *solve = &result->solve;
    const int is_new =
        result->newton.definite == 0 &&
        (solve->method == OST_METHOD_DIRECT ? problem->conservative : !(solve->condition_estimate > slow));
    if (ost_problem_is_linear(problem) || !problem->scene || problem->scene->c->watch_count == 0 || is_new)
        return OST_SUCCESS;
    return move_stiffness(analysis, t, result, 1, OST_UPDATE_REBUILD);
}

/* The reaction that the case asks about has its error already, unless its adjoint problem is to say what a solve that
 * was stopped has left of it, too. */
static void take_interest(const OstCase *c, OstResult *result)
{
    const OstInterestError *interest = &result->interest;
    if (interest->watch && interest->watch->kind == OST_WATCH_REACTION && !result->solve.stopped)
        result->reactions[c->interest - 1] = (OstWatchedReaction){.known = 1, .error = interest->error};
}

/* Is there one whose adjoint problem has had no answer? */
static int misses_reaction(const OstProblem *problem, const OstResult *result)
{
    const OstCase *c = problem->scene->c;
    int any = 0;
    for (int w = 0; w < c->watch_count && ost_reactions_have_adjoint(problem); w++)
        any |= c->watches[w].kind == OST_WATCH_REACTION && !result->reactions[w].known;
    return any;
}

/* Of watched reactions and mean stresses, one for each quantity; by linear theory load cases, and a path's steps, share
 * adjoint problems.
 */
static OstStatus estimate_reactions(OstAnalysis *analysis, OstEstimate *estimate, double t, OstResult *result)
{
    const OstProblem *problem = analysis->problem, state = at_answer(analysis, result);
    const OstLinear *linear = analysis->work;
    if (!problem->scene)
        return OST_SUCCESS;
    const int shares =
        ost_problem_is_linear(problem) && (analysis->serves_several || problem->scene->c->path_steps > 0);
    OstReactions *kept = analysis->company ? &analysis->company->reactions : &analysis->reactions;
    int renewed = 0;
    OST_TRY(ost_agree(result->ctx, OST_NEW(result->ctx, &result->reactions, problem->scene->c->watch_count)));
    take_interest(problem->scene->c, result);
    for (int again = 1; again;) {
        OST_TRY(ost_reactions_find(&state, estimate, linear->stiffness.solver, t, result->displacement,
                                   result->answer.relative, result->tet_error, shares ? kept : NULL,
                                   result->reactions));
        again = !renewed && misses_reaction(problem, result);
        if (again)
            OST_TRY(renew_for_adjoints(analysis, t, result, &renewed));
        again &= renewed;
    }
    return OST_SUCCESS;
}

static OstStatus find_cut_off(OstResult *result)
{
    OstCutOff cut_off;
    OST_TRY(ost_mesh_cut_off(result->mesh, &cut_off));
    result->answer.cut_off = cut_off.lacking;
    result->answer.filled_in = cut_off.filled;
    return OST_SUCCESS;
}

static OstStatus estimate_tets(OstAnalysis *analysis, OstEstimate *estimate, double t, OstResult *result)
{
    OstContext *ctx = result->ctx;
    const OstLinear *linear = analysis->work;
    double *share = NULL;
    OstSurplus surplus;
    OstStatus status = ost_result_allow_error(analysis->problem, result);
    OST_THEN(OST_NEW(ctx, &share, result->mesh->regions.count));
    OST_TRY_DONE(ost_agree(ctx, status));
    surplus = ost_result_surplus(result);
    if (!result->answer.known) /* the solve may have been stopped by it */
        OST_TRY_DONE(
            ost_estimate_find(estimate, linear->stiffness.solver, t, result->displacement, &result->answer, &surplus));
    if (result->answer.known)
        OST_TRY_DONE(find_worst(result, share, &result->answer));
    if (result->answer.known)
        OST_TRY_DONE(find_cut_off(result));
    if (result->answer.known)
        OST_TRY_DONE(move_for_adjoints(analysis, t, result));
    if (result->answer.known && asks_of_quantity(analysis->problem))
        OST_TRY_DONE(estimate_interest(analysis, estimate, t, result));
    if (result->answer.known && !analysis->leaves_reactions)
        OST_TRY_DONE(estimate_reactions(analysis, estimate, t, result));
    if (!result->surplus && !analysis->problem->pressures && result->solve.condition_estimate > slow)
        result->answer.displacement_is_least = 1;
    if (ost_distributing_any(analysis->problem)) { /* e is that of fixed forces, and theirs has an error too */
        result->answer.displacement = NAN;
        result->answer.displacement_is_least = 0;
    }
    if (!result->answer.known) {
        OST_FREE(result->tet_error);
        OST_FREE(result->surplus);
        OST_FREE(result->stress_surplus);
        OST_FREE(result->along_axes_surplus);
        OST_FREE(result->node_stress_surplus);
    }
    for (OstLocal tet = 0; tet < result->mesh->owned_tets && result->answer.known; tet++)
        result->tet_error[tet] = sqrt(fmax(result->tet_error[tet], 0.0));
done:
    OST_FREE(share);
    return status;
}

OstStatus ost_analysis_estimate(OstAnalysis *analysis, double t, OstResult *result)
{
    OstEstimate *estimate = NULL;
    const OstProblem state = at_answer(analysis, result);
    ost_ledger_enter(analysis->ctx, OST_EFFECT_ERROR_ESTIMATE);
    const int wants_reactions = !analysis->leaves_reactions && ost_reactions_are_watched(analysis->problem);
    const int has_all = result->answer.known && !asks_of_quantity(analysis->problem) && !wants_reactions;
    const int needs_own = !has_all && !analysis->estimate;
    OstStatus status = result->answer.known ? OST_SUCCESS : renew_solver(analysis, t, result);
    if (needs_own)
        OST_THEN(ost_estimate_create(&state, &estimate));
    OST_THEN(estimate_tets(analysis, needs_own ? estimate : analysis->estimate, t, result));
    ost_estimate_destroy(&estimate);
    ost_ledger_leave(analysis->ctx);
    return status;
}

OstStatus ost_analysis_find_reactions(OstAnalysis *analysis, OstResult *result)
{
    OstEstimate *estimate = NULL;
    const OstProblem state = at_answer(analysis, result);
    if (!analysis->leaves_reactions || !result->answer.known || !ost_reactions_are_watched(analysis->problem))
        return OST_SUCCESS;
    analysis->leaves_reactions = 0;
    ost_ledger_enter(analysis->ctx, OST_EFFECT_ERROR_ESTIMATE);
    OstStatus status = ost_estimate_create(&state, &estimate);
    OST_THEN(move_for_adjoints(analysis, result->t, result));
    for (OstLocal tet = 0; tet < result->mesh->owned_tets; tet++)
        result->tet_error[tet] *= result->tet_error[tet];
    OST_THEN(estimate_reactions(analysis, estimate, result->t, result));
    for (OstLocal tet = 0; tet < result->mesh->owned_tets; tet++)
        result->tet_error[tet] = sqrt(result->tet_error[tet]);
    ost_estimate_destroy(&estimate);
    ost_ledger_leave(analysis->ctx);
    return status;
}

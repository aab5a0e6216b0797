/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/analysis.h"

#include "core/error.h"
#include "core/memory.h"
#include "orthostat/path.h"
#include "recovery/recovery.h"
#include "solve/buckling/buckling.h"
#include "solve/distributing/distributing.h"
#include "solve/linear.h"

OstStatus ost_analysis_create(OstProblem *problem, const OstSolverOptions *options, OstAnalysis **analysis)
{
    OstContext *ctx = problem->ctx;
    const int is_linear = problem->beyond_linear == OST_FORMULATION_LINEAR;
    const OstStrategy *strategy = is_linear ? &ost_linear_strategy : &ost_nonlinear_strategy;
    *analysis = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, analysis, 1)));
    **analysis = (OstAnalysis){.ctx = ctx, .problem = problem, .options = *options, .strategy = strategy};
    return OST_SUCCESS;
}

void ost_analysis_destroy(OstAnalysis **analysis)
{
    if (!*analysis)
        return;
    (*analysis)->strategy->release(*analysis);
    ost_estimate_destroy(&(*analysis)->estimate);
    ost_reactions_clear(&(*analysis)->reactions);
    OST_FREE(*analysis);
}

OstStatus ost_analysis_take_loading(OstAnalysis *analysis)
{
    if (!analysis->estimate)
        return OST_SUCCESS;
    ost_ledger_enter(analysis->ctx, OST_EFFECT_ERROR_ESTIMATE);
    const OstStatus status = ost_estimate_take_loading(analysis->estimate);
    ost_ledger_leave(analysis->ctx);
    return status;
}

OstStatus ost_analysis_prepare(OstAnalysis *analysis)
{
    OstVerdict before = {.count = 0};
    OstStatus status = OST_SUCCESS;
    const int is_first = !analysis->work;
    if (is_first)
        status = ost_guard_supports(analysis->problem, &before);
    if (status == OST_SUCCESS && before.count == 0)
        status = analysis->strategy->prepare(analysis, &before);
    if (is_first && (status != OST_SUCCESS || before.count > 0))
        analysis->strategy->release(analysis);
    return status == OST_SUCCESS ? ost_verdict_raise(analysis->ctx, &before) : status;
}

/* An answer that was corrected by the tets has another residual than the one that was solved for. */
static void restate_residual(double requested, OstResult *result)
{
    OstSolveReport *report = &result->solve;
    report->relative_residual = result->checks.relative_residual;
    if (report->rounding_limited || report->relative_residual <= requested)
        return;
    report->rounding_limited = 1;
    report->attainable_residual = report->relative_residual;
}

OstStatus ost_analysis_conclude(const OstAnalysis *analysis, double t, OstStatus solved, const OstSolvedFor *solved_for,
                                unsigned fields, OstResult *result)
{
    OstContext *ctx = analysis->ctx;
    OstProblem state = *analysis->problem; /* forces and energies of the answer: with its pressure, if it has one */
    OstMeansVisit means;
    state.field = result->field;
    OST_TRY(ost_result_take_load(result, analysis->problem, t));
    result->formulation = ost_problem_formulation(analysis->problem);
    result->conservative = analysis->problem->conservative;
    OST_TRY(ost_agree(ctx, ost_result_prepare_means(result, fields, &means)));
    OST_TRY(ost_guard_after(&state, analysis->options.relative_residual, solved_for, means, result));
    if (analysis->problem->automatic && !result->newton.used && ost_buckling_ends(result))
        ost_buckling_object(result);
    if (analysis->problem->driven)
        OST_TRY(ost_distributing_react(analysis->problem, t, result));
    if (solved_for->errors.known) /* one error of the displacement is stated */
        result->solve.error_estimate = solved_for->errors.displacement;
    if (solved_for->errors.corrected)
        restate_residual(analysis->options.relative_residual, result);
    OST_TRY(ost_result_find_largest(result));
    OST_TRY(ost_agree(ctx, ost_result_recover(result, fields)));
    return result->unfinished ? OST_RAISE(ctx, solved, "%s", result->verdict.text[0])
                              : ost_verdict_raise(ctx, &result->verdict);
}

/* What estimates share, where more loads follow. */
static OstStatus keep_estimate(OstAnalysis *analysis)
{
    if (!analysis->serves_several || analysis->estimate || analysis->problem->pressures) /* each answer has its own */
        return OST_SUCCESS;
    ost_ledger_enter(analysis->ctx, OST_EFFECT_ERROR_ESTIMATE);
    OstStatus status = ost_estimate_create(analysis->problem, &analysis->estimate);
    OST_THEN(ost_estimate_remember(analysis->estimate));
    ost_ledger_leave(analysis->ctx);
    return status;
}

OstStatus ost_analysis_make_common(OstAnalysis *analysis, unsigned fields)
{
    OST_TRY(ost_analysis_prepare(analysis));
    OstStiffnessSolver *stiffness = &((OstLinear *)analysis->work)->stiffness;
    if (!stiffness->solver)
        OST_TRY(ost_stiffness_solver_make(stiffness));
    return fields >> OST_FIELD_ERROR & 1U ? keep_estimate(analysis) : OST_SUCCESS;
}

OstStatus ost_analysis_find_buckling(const OstAnalysis *analysis, OstResult *result)
{
    const OstLinear *linear = analysis->work;
    const OstProblem *problem = analysis->problem;
    if (problem->c && problem->c->buckling_modes > problem->buckling_modes)
        ost_warn(analysis->ctx, "no buckling modes are looked for: %s",
                 ost_effect_state(problem->effects, OST_EFFECT_BUCKLING)->reason);
    if (problem->buckling_modes > 0 && !problem->conservative) {
        ost_warn(analysis->ctx, "no buckling modes are looked for: the pressure follows a surface with a free rim, so "
                                "that no energy tells where the body leaves its state at rest");
        return OST_SUCCESS;
    }
    if (problem->buckling_modes == 0 || !result->reached)
        return OST_SUCCESS;
    return ost_buckling_find(analysis->problem, linear->stiffness.solver, result);
}

static OstStatus solve(OstAnalysis *analysis, int is_last, unsigned fields, OstResult *result)
{
    OstSolvedFor solved_for = {0};
    OST_TRY(ost_analysis_prepare(analysis));
    result->unknowns = ost_problem_unknowns(analysis->problem);
    result->asked = fields;
    if (fields >> OST_FIELD_ERROR & 1U)
        OST_TRY(keep_estimate(analysis));
    const OstStatus solved =
        ost_guard_explain(analysis->problem, analysis->strategy->solve(analysis, result, &solved_for));
    if (!result->reached)
        return solved;
    if (analysis->strategy == &ost_linear_strategy)
        OST_TRY(ost_analysis_find_buckling(analysis, result));
    ost_result_take_outcome(result, solved);
    if (!result->unfinished)
        OST_TRY(solved);
    const double t = result->newton.used ? result->newton.reached : 1.0;
    if (fields >> OST_FIELD_ERROR & 1U)
        OST_TRY(ost_analysis_estimate(analysis, t, result));
    if (is_last) {
        analysis->strategy->release(analysis);
        ost_problem_release_stiffness(analysis->problem);
    }
    return ost_analysis_conclude(analysis, t, solved, &solved_for, fields, result);
}

OstStatus ost_analysis_solve(OstAnalysis *analysis, unsigned fields, OstResult **result)
{
    OST_TRY(ost_result_create(analysis->problem, result));
    return solve(analysis, 0, fields, *result);
}

OstStatus ost_problem_solve(OstProblem *problem, const OstSolverOptions *options, unsigned fields, OstResult **result)
{
    OstAnalysis *analysis = NULL;
    OST_TRY(ost_result_create(problem, result));
    OstStatus status = ost_analysis_create(problem, options, &analysis);
    OST_THEN(solve(analysis, 1, fields, *result));
    ost_analysis_destroy(&analysis);
    ost_problem_release_stiffness(problem);
    return status;
}

OstStatus ost_problem_dry_run(OstProblem *problem, const OstSolverOptions *options)
{
    OstAnalysis *analysis = NULL;
    OstStatus status = ost_analysis_create(problem, options, &analysis);
    OST_THEN(ost_analysis_prepare(analysis));
    ost_analysis_destroy(&analysis);
    ost_problem_release_stiffness(problem);
    return status;
}

OstStatus ost_scene_dry_run(const OstScene *scene)
{
    OstProblem *problem = NULL;
    OstStatus status = ost_scene_problem(scene, &problem);
    OST_THEN(ost_problem_dry_run(problem, &scene->c->solver));
    ost_problem_destroy(&problem);
    return status;
}

/* The end of the case's path. */
static OstStatus solve_path(const OstScene *scene, unsigned fields, OstResult **result)
{
    OstPath *path = NULL;
    OstStatus status = ost_scene_path(scene, &path);
    for (int i = 0; i < scene->c->path_steps && status == OST_SUCCESS; i++) {
        ost_result_destroy(result);
        status = ost_path_advance(path, i + 1 == scene->c->path_steps ? fields : 0, result);
    }
    ost_path_destroy(&path);
    return status;
}

OstStatus ost_scene_solve(const OstScene *scene, OstResult **result)
{
    const unsigned fields = ost_scene_result_fields(scene);
    OstProblem *problem = NULL;
    *result = NULL;
    if (ost_effect_on(&scene->plan.effects, OST_EFFECT_PATH))
        return solve_path(scene, fields, result);
    OstStatus status = ost_scene_problem(scene, &problem);
    OST_THEN(ost_problem_solve(problem, &scene->c->solver, fields, result));
    ost_problem_destroy(&problem);
    return status;
}

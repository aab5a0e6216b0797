/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/analysis.h"

#include "core/error.h"
#include "core/memory.h"
#include "solve/recovery.h"
#include "solve/strategy.h"

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
    OST_FREE(*analysis);
}

/* Makes all that the solve needs. All objections are raised as one failure. */
static OstStatus prepare(OstAnalysis *analysis)
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

static OstStatus solve(OstAnalysis *analysis, int is_last, unsigned fields, OstResult *result)
{
    OstContext *ctx = analysis->ctx;
    OstSolvedFor solved_for = {0.0, 0.0};
    OST_TRY(prepare(analysis));
    result->unknowns = ost_problem_unknowns(analysis->problem);
    const OstStatus solved = analysis->strategy->solve(analysis, result, &solved_for);
    if (!result->reached)
        return solved;
    result->unfinished = solved == OST_NOT_CONVERGED;
    if (result->unfinished)
        ost_object(&result->verdict, solved, "%s", ost_error_text(ctx));
    else
        OST_TRY(solved);
    if (is_last) {
        analysis->strategy->release(analysis);
        ost_problem_release_stiffness(analysis->problem);
    }
    OST_TRY(ost_result_take_load(result, analysis->problem));
    result->formulation = ost_problem_formulation(analysis->problem);
    OST_TRY(ost_guard_after(analysis->problem, analysis->options.relative_residual, &solved_for, result));
    OST_TRY(ost_result_find_largest(result));
    OST_TRY(ost_agree(ctx, ost_result_recover(result, fields)));
    return result->unfinished ? OST_RAISE(ctx, solved, "%s", result->verdict.text[0])
                              : ost_verdict_raise(ctx, &result->verdict);
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
    OST_THEN(prepare(analysis));
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

OstStatus ost_scene_solve(const OstScene *scene, OstResult **result)
{
    const int recovers = ost_effect_on(&scene->plan.effects, OST_EFFECT_RECOVERY);
    OstProblem *problem = NULL;
    *result = NULL;
    OstStatus status = ost_scene_problem(scene, &problem);
    OST_THEN(ost_problem_solve(problem, &scene->c->solver, recovers ? scene->c->output_fields : 0, result));
    ost_problem_destroy(&problem);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"
#include "algebra/solver_plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/coarse_space.h"
#include "problem/free_body.h"
#include "solve/strategy.h"

/* One linear solve: K v = P (f - K g), u = v + g. Stiffness and solver are made once, for all loads. */
typedef struct Linear {
    OstRowGeometry rows;
    OstLinearSpace *coarse; /* of the linear tets under quadratic ones, or NULL */
    OstSolverFacts facts;
    OstSolver *solver; /* made by the first solve */
    double *rhs, *v;   /* 3 × rows */
    double rigid_motion;
} Linear;

static void release(OstAnalysis *analysis)
{
    Linear *linear = analysis->work;
    if (!linear)
        return;
    ost_solver_destroy(&linear->solver);
    ost_linear_space_destroy(&linear->coarse);
    ost_row_geometry_release(&linear->rows);
    OST_FREE(linear->rhs);
    OST_FREE(linear->v);
    OST_FREE(analysis->work);
}

/* The stiffness is filled once: its scatter map is not needed again. */
static OstStatus prepare_stiffness(OstAnalysis *analysis, OstVerdict *before)
{
    OstContext *ctx = analysis->ctx;
    OstProblem *problem = analysis->problem;
    OST_TRY(ost_problem_stiffness(problem, 1.0, NULL, NULL));
    ost_problem_release_scatter(problem);
    Linear *linear = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &linear, 1)));
    analysis->work = linear;
    const size_t unknowns = 3 * (size_t)problem->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &linear->rhs, unknowns);
    OST_THEN(OST_NEW(ctx, &linear->v, unknowns));
    OST_TRY(ost_agree(ctx, status));
    ost_ledger_enter(ctx, OST_LEDGER_HIERARCHY);
    status = ost_row_geometry_create(problem->system, problem->field, problem->with_metric, &linear->rows);
    OST_THEN(ost_problem_facts(problem, &linear->facts));
    ost_ledger_leave(ctx);
    OST_TRY(status);
    return ost_guard_stiffness(problem, linear->rows.modes, &linear->rigid_motion, before);
}

static OstStatus prepare(OstAnalysis *analysis, OstVerdict *before)
{
    OstProblem *problem = analysis->problem;
    if (!analysis->work)
        OST_TRY(prepare_stiffness(analysis, before));
    Linear *linear = analysis->work;
    OST_TRY(ost_agree(analysis->ctx, ost_problem_right_hand_side(problem, 1.0, linear->rhs)));
    return ost_guard_load(problem, linear->rhs, before);
}

/* A problem made without a case has no effects; the rule of this one is then applied here. */
static int needs_linear_space(const OstProblem *problem, const OstSolverPlan *plan)
{
    return problem->effects ? ost_effect_on(problem->effects, OST_EFFECT_LINEAR_SPACE)
                            : problem->mesh->nodes_per_tet == 10 && ost_solver_may_be_multigrid(plan);
}

static OstStatus make_solver(const OstAnalysis *analysis, Linear *linear)
{
    const OstProblem *problem = analysis->problem;
    OstSolverPlan plan;
    ost_solver_plan(&analysis->options, &linear->facts, &plan);
    if (needs_linear_space(problem, &plan))
        OST_TRY(ost_linear_space_create(problem->system, problem->field, problem->with_metric, &linear->coarse));
    OstSolverGeometry geometry = linear->rows.geometry;
    geometry.coarse = linear->coarse ? &linear->coarse->space : NULL;
    geometry.facts = &linear->facts;
    return ost_solver_create(analysis->ctx, problem->system->matrix, &geometry, &analysis->options, &linear->solver);
}

static OstStatus describe_rhs(OstContext *ctx, const Linear *linear, size_t unknowns, OstSolvedFor *solved_for)
{
    double sums[2] = {0.0};
    for (size_t i = 0; i < unknowns; i++) {
        sums[0] += linear->rhs[i] * linear->rhs[i];
        sums[1] += linear->rhs[i] * linear->v[i];
    }
    OST_TRY(ost_sum(ctx, 2, sums));
    *solved_for = (OstSolvedFor){sqrt(sums[0]), sums[1]};
    return OST_SUCCESS;
}

static OstStatus solve(OstAnalysis *analysis, OstResult *result, OstSolvedFor *solved_for)
{
    const OstProblem *problem = analysis->problem;
    Linear *linear = analysis->work;
    result->checks.rigid_motion = linear->rigid_motion;
    if (!linear->solver)
        OST_TRY(make_solver(analysis, linear));
    const OstStatus solved = ost_solver_solve(linear->solver, linear->rhs, linear->v, &result->solve);
    OST_TRY(ost_problem_displacement(problem, 1.0, linear->v, result->displacement));
    result->reached = solved == OST_SUCCESS || solved == OST_NOT_CONVERGED;
    if (!result->reached)
        return solved;
    const size_t unknowns = 3 * (size_t)problem->system->matrix->rows;
    OST_TRY(describe_rhs(analysis->ctx, linear, unknowns, solved_for));
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, result->displacement));
    return solved;
}

const OstStrategy ost_linear_strategy = {.prepare = prepare, .solve = solve, .release = release};

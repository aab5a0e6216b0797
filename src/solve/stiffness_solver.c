/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/stiffness_solver.h"

#include "algebra/solver_plan.h"
#include "core/error.h"

void ost_stiffness_solver_release(OstStiffnessSolver *stiffness)
{
    ost_solver_destroy(&stiffness->solver);
    ost_linear_space_destroy(&stiffness->coarse);
    ost_row_geometry_release(&stiffness->rows);
}

OstStatus ost_stiffness_solver_create(OstProblem *problem, const OstSolverOptions *options,
                                      OstStiffnessSolver *stiffness)
{
    OstContext *ctx = problem->ctx;
    *stiffness = (OstStiffnessSolver){.problem = problem, .options = *options};
    ost_ledger_enter(ctx, OST_LEDGER_HIERARCHY);
    OstStatus status = ost_row_geometry_create(problem->system, problem->field, problem->with_metric, &stiffness->rows);
    OST_THEN(ost_problem_facts(problem, &stiffness->facts));
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS)
        ost_stiffness_solver_release(stiffness);
    return status;
}

/* A problem made without a case has no effects; the rule of this one is then applied here. */
static int needs_linear_space(const OstProblem *problem, const OstSolverPlan *plan)
{
    return problem->effects ? ost_effect_on(problem->effects, OST_EFFECT_LINEAR_SPACE)
                            : problem->mesh->nodes_per_tet == 10 && ost_solver_may_be_multigrid(plan);
}

OstStatus ost_stiffness_solver_make(OstStiffnessSolver *stiffness)
{
    const OstProblem *problem = stiffness->problem;
    OstSolverPlan plan;
    ost_solver_plan(&stiffness->options, &stiffness->facts, &plan);
    if (needs_linear_space(problem, &plan))
        OST_TRY(ost_linear_space_create(problem->system, problem->field, problem->with_metric, &stiffness->coarse));
    if (!stiffness->rows.geometry.owner) { /* lent so that the solver learns where they have moved */
        stiffness->rows.kept = 1;
        ost_row_geometry_lend(&stiffness->rows);
    }
    OstSolverGeometry geometry = stiffness->rows.geometry;
    geometry.coarse = stiffness->coarse ? &stiffness->coarse->space : NULL;
    geometry.facts = &stiffness->facts;
    return ost_solver_create(problem->ctx, problem->system->matrix, &geometry, &stiffness->options, &stiffness->solver);
}

OstStatus ost_stiffness_solver_rebuild(OstStiffnessSolver *stiffness, double t, const double *displacement)
{
    const OstProblem *problem = stiffness->problem;
    OST_TRY(ost_row_geometry_move(&stiffness->rows, displacement));
    if (stiffness->coarse)
        OST_TRY(ost_linear_space_move(stiffness->coarse, problem->field, OST_FORMULATION_CONSISTENT,
                                      ost_problem_eigen_share(problem, t), displacement));
    return ost_solver_update(stiffness->solver, OST_UPDATE_REBUILD);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/parallel/halo.h"
#include "core/small.h"
#include "solve/newton_data.h"

#include <math.h>
#include <string.h>

/* A new hierarchy pays once a digit takes so many times the iterations, and so many more, than when it was new. */
static const double more_iterations = 1.5, further_iterations = 1.0;

/* A failure that Newton's method can answer: the matrix is indefinite, or too hard for the solver. */
static int can_go_on(OstStatus status)
{
    return status == OST_NOT_CONVERGED || status == OST_INVALID_INPUT;
}

/* The classical form's own stiffness leaves out how R changes; that of the consistent one has it, and is near. */
static OstStatus fill(OstNewton *newton, int definite)
{
    OstProblem *problem = newton->problem;
    const OstFormulation formulation = problem->formulation;
    ost_problem_take_formulation(problem, OST_FORMULATION_CONSISTENT);
    const OstStatus status = definite ? ost_problem_definite_stiffness(problem, newton->t, newton->displacement, NULL)
                                      : ost_problem_stiffness(problem, newton->t, newton->displacement, NULL);
    ost_problem_take_formulation(problem, formulation);
    return status;
}

/* Fills the stiffness at the displacement, and brings the solver up to date with it. */
static OstStatus update(OstNewton *newton, int definite)
{
    const int rebuild = newton->rebuild;
    OST_TRY(fill(newton, definite));
    if (rebuild || newton->solve.method == OST_METHOD_DIRECT) {
        newton->report.setups++;
        newton->cost = 0.0;
    }
    newton->stiffness->moved = 1;
    newton->rebuild = 1; /* should what follows fail */
    if (rebuild)
        OST_TRY(ost_stiffness_solver_rebuild(newton->stiffness, newton->t, newton->displacement));
    else
        OST_TRY(ost_solver_update(newton->stiffness->solver, OST_UPDATE_KEEP));
    newton->rebuild = 0;
    return OST_SUCCESS;
}

/* Has the hierarchy become too old? */
static void judge_hierarchy(OstNewton *newton)
{
    const double digits = fmax(-log10(fmax(newton->solve.relative_residual, 1e-16)), 1.0);
    const double cost = newton->solve.iterations / digits;
    if (newton->cost == 0.0)
        newton->cost = fmax(cost, 1.0);
    else if (cost > more_iterations * newton->cost + further_iterations)
        newton->rebuild = 1;
}

/* The correction on the nodes, ghosts included: zero where the displacement is prescribed. */
static OstStatus take_direction(OstNewton *newton)
{
    const OstProblem *problem = newton->problem;
    const OstMesh *mesh = problem->mesh;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const OstLocal row = problem->system->row_of_node[node];
        double *direction = newton->direction + 3 * (size_t)node;
        double projector[9];
        memset(direction, 0, 3 * sizeof *direction);
        if (row < 0)
            continue;
        ost_supports_get(problem->supports, node, projector, NULL);
        ost_apply3(projector, newton->correction + 3 * (size_t)row, direction);
    }
    return ost_agree(newton->ctx, ost_halo_import(mesh->halo, 3 * sizeof(double), newton->direction));
}

/* One attempt. *again: the hierarchy was old, and a new one may find what it did not. */
static OstStatus attempt(OstNewton *newton, int definite, double forcing, const double *rhs, int *again)
{
    const int old = !newton->rebuild && newton->solve.method != OST_METHOD_DIRECT;
    ost_solver_aim(
        newton->stiffness->solver,
        (OstSolverAim){.relative_residual = forcing, .crude = 1, .probing = !definite, .first = newton->method});
    newton->solve.indefinite = 0;
    OST_TRY(update(newton, definite));
    const OstStatus status = ost_solver_solve(newton->stiffness->solver, rhs, newton->correction, &newton->solve);
    newton->report.linear_iterations += newton->solve.iterations;
    *again = can_go_on(status) && old && !newton->solve.indefinite;
    if (status == OST_SUCCESS && !old)
        newton->method = newton->solve.method;
    return status;
}

OstStatus ost_newton_solve(OstNewton *newton, int definite, double forcing, const double *rhs, int *found)
{
    int again = 0;
    *found = 0;
    OstStatus status = attempt(newton, definite, forcing, rhs, &again);
    if (again) {
        newton->rebuild = 1;
        status = attempt(newton, definite, forcing, rhs, &again);
    }
    if (can_go_on(status)) {
        ost_log(newton->ctx, OST_LOG_VERBOSE, "newton: the %s stiffness gives no correction: %s",
                definite ? "definite" : "exact", ost_error_text(newton->ctx));
        newton->rebuild |= !newton->solve.indefinite;
        return OST_SUCCESS;
    }
    OST_TRY(status);
    judge_hierarchy(newton);
    *found = 1;
    return take_direction(newton);
}

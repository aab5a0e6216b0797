/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/saddle.h"
#include "core/error.h"
#include "solve/newton_data.h"

#include <string.h>

/* Newton's method for both equations of a mixed form: the forces balance, with m p in the stress, and
 * m'(U - I - e0) = looseness p in the mean with each pressure's share. */

/* Where the pressures of a state's displacement begin. */
static size_t first_pressure(const OstNewton *newton)
{
    return 3 * (size_t)newton->problem->mesh->node_count;
}

static size_t unknowns(const OstNewton *newton)
{
    return 3 * (size_t)newton->problem->system->matrix->rows;
}

void ost_newton_take_pressure(OstNewton *newton, const double *displacement)
{
    ost_pressure_of_tets(newton->problem->pressures, displacement + first_pressure(newton), newton->of_tets);
}

OstStatus ost_newton_find_volume(OstNewton *newton, const double *displacement)
{
    const OstProblem *problem = newton->problem;
    double *residual = newton->residual + unknowns(newton);
    OST_TRY(ost_pressure_volume(problem->pressures, problem->field, problem->formulation,
                                ost_problem_eigen_share(problem, newton->t), displacement, residual, NULL));
    for (OstLocal i = 0; i < problem->pressures->owned; i++)
        residual[i] = -residual[i];
    return OST_SUCCESS;
}

OstStatus ost_newton_move_volume(OstNewton *newton, const double *displaced, double share)
{
    double *residual = newton->residual + unknowns(newton), *before = newton->correction + unknowns(newton);
    const size_t count = (size_t)newton->problem->pressures->owned;
    memcpy(before, residual, count * sizeof *before);
    OST_TRY(ost_agree(newton->ctx, ost_newton_find_volume(newton, displaced)));
    for (size_t i = 0; i < count; i++)
        residual[i] = before[i] + (residual[i] - before[i]) / share;
    return OST_SUCCESS;
}

OstStatus ost_newton_mixed_norm(const OstNewton *newton, double *norm)
{
    const OstProblem *problem = newton->problem;
    const OstSaddle saddle = {problem->coupling, newton->residual + unknowns(newton), NULL};
    return ost_saddle_size(problem->system->matrix, &saddle, newton->residual, norm);
}

OstSaddle ost_newton_saddle(const OstNewton *newton, const double *rhs)
{
    if (!ost_newton_is_mixed(newton))
        return (OstSaddle){0};
    return (OstSaddle){newton->problem->coupling, rhs + unknowns(newton), newton->correction + unknowns(newton)};
}

OstStatus ost_newton_solve_mixed(OstNewton *newton, const double *rhs)
{
    const OstSaddle saddle = ost_newton_saddle(newton, rhs);
    return ost_solver_solve_mixed(newton->stiffness->solver, &saddle, rhs, newton->correction, &newton->solve);
}

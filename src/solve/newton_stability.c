/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "solve/newton_data.h"

#include <math.h>
#include <string.h>

/* Is a state at rest stable, and if not, where does the body go? */

/* Solves of the search for the softest motion, and attempts to leave a state that is not stable. */
enum { MOTIONS = 3, ATTEMPTS = 3 };

/* The body is pushed along that motion by this share of its size. */
static const double push = 1e-3;

/* Forces that vary slowly over the body, in all directions and no symmetry of it: every soft motion has part in them.
 */
static OstStatus smooth_forces(const OstNewton *newton, double *forces, double *size)
{
    const OstSystem *system = newton->problem->system;
    const OstMesh *mesh = newton->problem->mesh;
    static const double share[3][4] = {
        {0.31, 0.83, -0.47, 0.61}, {-0.73, 0.29, 0.59, -0.37}, {0.53, -0.67, 0.41, 0.79}};
    double low[3], high[3];
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    *size = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    for (size_t row = 0; row < (size_t)system->matrix->rows; row++) {
        const size_t node = (size_t)system->node_of_row[row];
        double projector[9], force[3];
        for (int i = 0; i < 3; i++) {
            force[i] = share[i][3];
            for (int j = 0; j < 3; j++)
                force[i] += share[i][j] * (mesh->coordinates[3 * node + (size_t)j] - low[j]) / *size;
        }
        ost_supports_get(system->supports, (OstLocal)node, projector, NULL);
        ost_apply3(projector, force, forces + 3 * row);
    }
    if (ost_newton_is_mixed(newton))
        memset(forces + 3 * (size_t)system->matrix->rows, 0,
               (size_t)newton->problem->pressures->owned * sizeof *forces);
    return OST_SUCCESS;
}

/* The softest motion, by the power method on the inverse of the definite stiffness, in newton->direction. */
static OstStatus find_motion(OstNewton *newton, int *found)
{
    *found = 1;
    for (int k = 0; k < MOTIONS && *found; k++) {
        if (k > 0)
            memcpy(newton->residual, newton->correction,
                   3 * (size_t)newton->problem->system->matrix->rows * sizeof(double));
        OST_TRY(ost_newton_solve(newton, 1, 1e-2, newton->residual, found));
    }
    return OST_SUCCESS;
}

static OstStatus push_along(OstNewton *newton, double size)
{
    const OstMesh *mesh = newton->problem->mesh;
    const size_t nodes = 3 * (size_t)mesh->node_count; /* pressures come after them, and stay */
    double largest = 0.0;
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes; i++)
        largest = fmax(largest, fabs(newton->direction[i]));
    OST_TRY(ost_max(newton->ctx, 1, &largest));
    const double length = push * size / largest;
    memcpy(newton->candidate, newton->displacement, newton->count * sizeof(double));
    memset(newton->direction + nodes, 0, (newton->count - nodes) * sizeof(double));
    return ost_newton_move(newton, newton->candidate, newton->direction, length, newton->displacement);
}

/* The pressures may hold what the rest of the stiffness does not. *stable: also where that is not known. */
static OstStatus judge_mixed(OstNewton *newton, int *stable)
{
    OstGlobal negative;
    int known;
    OST_TRY(ost_solver_count_negative(newton->stiffness->solver, newton->problem->coupling, &negative, &known));
    newton->report.stability_unknown = !known;
    *stable = !known || negative == 0;
    return OST_SUCCESS;
}

/* A state is stable where the symmetric part of its stiffness is definite; where it is not, it may be. The definite
 * stiffness is what the solver then has, as before. */
static OstStatus probe_without_skew(OstNewton *newton)
{
    double size = 0.0;
    int stable = 0, found = 0;
    newton->moved = 0;
    OST_TRY(smooth_forces(newton, newton->residual, &size));
    newton->without_skew = 1;
    OstStatus status = ost_newton_solve(newton, 0, 1e-3, newton->residual, &stable);
    newton->without_skew = 0;
    if (!stable && ost_newton_is_mixed(newton))
        OST_THEN(judge_mixed(newton, &stable));
    newton->report.stability_unknown = stable ? newton->report.stability_unknown : 2;
    if (!stable)
        OST_THEN(ost_newton_solve(newton, 1, 1e-2, newton->residual, &found));
    return status;
}

/* Estimates go on with the solver that there is: where it has factors of the exact stiffness alone, one of the definite
 * stiffness is made. */
static OstStatus leave_definite(OstNewton *newton)
{
    OstTurnedCouplings *const couplings = newton->couplings;
    int found = 0;
    if (!newton->by_factors)
        return OST_SUCCESS;
    newton->couplings = NULL;
    const OstStatus status = ost_newton_solve(newton, 1, 1e-2, newton->residual, &found);
    newton->couplings = couplings;
    return status;
}

/* The stiffness without the couplings may be indefinite though the body is stable: as many of its eigenvalues may be
 * negative as they hold. A state that is not stable is not left: whole corrections would lead back. */
static OstStatus probe_moved(OstNewton *newton, OstRest *rest)
{
    double size = 0.0;
    int found = 0, stable = 0, known = 1;
    OstGlobal negative = 0;
    newton->moved = 0;
    OST_TRY(ost_newton_evaluate(newton, newton->displacement));
    OST_TRY(smooth_forces(newton, newton->residual, &size));
    OST_TRY(ost_newton_solve_held(newton, 1e-3, newton->residual, &found));
    if (newton->indefinite || newton->by_factors)
        OST_TRY(ost_solver_count_negative(newton->stiffness->solver,
                                          ost_newton_is_mixed(newton) ? newton->problem->coupling : NULL, &negative,
                                          &known));
    known &= found;
    if (known)
        OST_TRY(ost_turned_couplings_are_stable(newton->couplings, negative, &stable));
    newton->report.stability_unknown = known ? 0 : 3;
    *rest = stable || !known ? OST_REST_FOUND : OST_REST_UNSTABLE;
    return leave_definite(newton);
}

OstStatus ost_newton_settle(OstNewton *newton, int most_iterations, OstRest *rest)
{
    *rest = OST_REST_FOUND;
    if (ost_newton_is_unsymmetric(newton))
        return probe_without_skew(newton);
    if (!ost_newton_has_energy(newton))
        return OST_SUCCESS;
    if (newton->couplings)
        return probe_moved(newton, rest);
    for (int attempt = 0;; attempt++) {
        double size = 0.0;
        int stable = 0, found = 0;
        newton->moved = 0;
        OST_TRY(smooth_forces(newton, newton->residual, &size));
        OST_TRY(ost_newton_solve(newton, 0, 1e-3, newton->residual, &stable));
        if (!stable && ost_newton_is_mixed(newton))
            OST_TRY(judge_mixed(newton, &stable));
        if (stable)
            return OST_SUCCESS;
        ost_log(newton->ctx, OST_LOG_VERBOSE,
                "newton: t %.6g: at rest, but not stable; pushed along its softest motion", newton->t);
        *rest = OST_REST_UNSTABLE;
        OST_TRY(find_motion(newton, &found));
        if (!found || attempt == ATTEMPTS)
            return OST_SUCCESS;
        OST_TRY(push_along(newton, size));
        newton->report.jumps++;
        newton->report.jump_at = newton->t;
        OST_TRY(ost_newton_find_rest(newton, most_iterations, rest));
        if (*rest != OST_REST_FOUND && *rest != OST_REST_ROUNDING)
            return OST_SUCCESS;
    }
}

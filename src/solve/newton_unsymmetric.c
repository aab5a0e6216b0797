/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "solve/newton_data.h"

#include <string.h>

/* Corrections where the load has no work function (pressure that follows a surface with a free rim): its stiffness has
 * a skew part. GMRES solves with it, preconditioned by the definite stiffness of some earlier state. */

typedef struct Skew {
    OstNewton *newton;
    double *moved;   /* 3 × node_count */
    double *product; /* 3 × owned_nodes */
} Skew;

/* y += P S P v on the rows */
static OstStatus add_skew(void *data, const double *v, double *y)
{
    const Skew *skew = data;
    const OstNewton *newton = skew->newton;
    const OstProblem *problem = newton->problem;
    OST_TRY(ost_newton_spread(newton, v, skew->moved));
    memset(skew->product, 0, 3 * (size_t)problem->mesh->owned_nodes * sizeof(double));
    OST_TRY(ost_agree(newton->ctx, ost_problem_add_skew(problem, newton->t, newton->displacement, skew->moved,
                                                        skew->product)));
    for (OstLocal row = 0; row < problem->system->matrix->rows; row++) {
        const size_t node = (size_t)problem->system->node_of_row[row];
        double projector[9], kept[3];
        ost_supports_get(problem->supports, (OstLocal)node, projector, NULL);
        ost_apply3(projector, skew->product + 3 * node, kept);
        for (size_t i = 0; i < 3; i++)
            y[3 * (size_t)row + i] += kept[i];
    }
    return OST_SUCCESS;
}

OstStatus ost_newton_solve_skew(OstNewton *newton, double forcing, const double *rhs)
{
    const OstMesh *mesh = newton->problem->mesh;
    Skew skew = {.newton = newton};
    const OstFurtherPart further = {.data = &skew, .add = add_skew};
    OstStatus status = OST_NEW(newton->ctx, &skew.moved, 3 * (size_t)mesh->node_count);
    OST_THEN(OST_NEW(newton->ctx, &skew.product, 3 * (size_t)mesh->owned_nodes));
    status = ost_agree(newton->ctx, status);
    OST_THEN(ost_solver_solve_unsymmetric(newton->stiffness->solver, &further, forcing, rhs, newton->correction,
                                          &newton->solve));
    OST_FREE(skew.moved);
    OST_FREE(skew.product);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "guard/freedom.h"
#include "guard/guard.h"
#include "guard/load_balance.h"
#include "guard/number_range.h"
#include "guard/rigid_motion.h"

#include <math.h>

/* A check that finds a fault adds an objection; a check that could not be made fails, on all ranks alike. */
static OstStatus take_objection(OstContext *ctx, OstStatus status, OstVerdict *before)
{
    if (status != OST_INVALID_INPUT && status != OST_CHECK_FAILED)
        return status;
    ost_object(before, status, "%s", ost_error_text(ctx));
    return OST_SUCCESS;
}

OstStatus ost_guard_supports(const OstProblem *problem, OstVerdict *before)
{
    const OstStatus status =
        ost_freedom_check(problem->mesh, problem->supports, ost_problem_name(problem), problem->free_body);
    return take_objection(problem->ctx, status, before);
}

OstStatus ost_guard_stiffness(const OstProblem *problem, const double *modes, double *resistance, OstVerdict *before)
{
    OstContext *ctx = problem->ctx;
    const int others = before->count;
    double of_tets = 0.0, of_rows = 0.0;
    OST_TRY(
        take_objection(ctx, ost_number_range_of_stiffness(problem->system->matrix, ost_problem_name(problem)), before));
    if (before->count > others)
        return OST_SUCCESS;
    OST_TRY(take_objection(ctx, ost_rigid_motion_of_tets(problem->mesh, problem->field, &of_tets), before));
    OST_TRY(take_objection(ctx, ost_rigid_motion_of_rows(problem->system, modes, &of_rows), before));
    *resistance = fmax(of_tets, of_rows);
    return OST_SUCCESS;
}

OstStatus ost_guard_load(const OstProblem *problem, const double *rhs, OstVerdict *before)
{
    OstContext *ctx = problem->ctx;
    const char *name = ost_problem_name(problem);
    if (problem->free_body)
        OST_TRY(take_objection(ctx, ost_load_balance_check(problem->mesh, problem->force, name), before));
    return take_objection(ctx, ost_number_range_of_load(problem->system->matrix, rhs, name), before);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/direct/direct.h"

#include "algebra/direct/mumps.h"
#include "algebra/krylov/cg.h"
#include "algebra/krylov/energy_error.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>

/* Refine u until a correction changes it by no more than this, relative to u: steps by factors are cheap. */
static const double settled = 1e-3;

struct OstDirect {
    OstCgSystem system;
    OstScaling *scaling;
    OstMumps *factors;
    double shift; /* added to the diagonal before factoring */
};

void ost_direct_destroy(OstDirect **direct)
{
    if (!*direct)
        return;
    ost_mumps_destroy(&(*direct)->factors);
    ost_scaling_destroy(&(*direct)->scaling);
    OST_FREE(*direct);
}

OstStatus ost_direct_create(const OstBlockMatrix *matrix, double memory, OstDirect **direct)
{
    OstDirect *made = NULL;
    *direct = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(matrix->ctx, OST_NEW(matrix->ctx, &made, 1)));
    OST_TRY_DONE(ost_scaling_create(matrix, &made->scaling));
    OST_TRY_DONE(ost_mumps_create_of_rows(matrix, made->scaling, memory, &made->shift, &made->factors));
    made->system = (OstCgSystem){.matrix = matrix, .scaling = made->scaling};
done:
    if (status != OST_SUCCESS)
        ost_direct_destroy(&made);
    *direct = made;
    return status;
}

/* An unconstrained body also factors once the diagonal is shifted: a rounding error of 0.1 or more gives it away. */
static OstStatus check_shifted(const OstDirect *direct, const OstSolveReport *report)
{
    if (report->error_estimate > 0.0 && isfinite(report->error_estimate) &&
        !ost_surely_beyond(report->rounding_error, report->rounding_spread, ost_least_digit))
        return OST_SUCCESS;
    return OST_RAISE(direct->system.matrix->ctx, OST_NOT_CONVERGED,
                     "rounded to double precision, the stiffness is not positive definite, or hardly: rounding leaves "
                     "the displacement less than one digit; %s",
                     ost_rounding_remedy);
}

void ost_direct_system(const OstDirect *direct, OstCgSystem *system, OstPreconditioner *factors)
{
    *system = direct->system;
    *factors = (OstPreconditioner){.data = direct->factors, .apply = ost_mumps_solve, .factors = 1};
}

OstStatus ost_direct_solve(OstDirect *direct, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    OstPreconditioner factors;
    OstCgSystem system;
    ost_direct_system(direct, &system, &factors);
    report->levels = 1;
    report->level_unknowns[0] = 3 * direct->system.matrix->global_rows;
    report->operator_complexity = 1.0;
    snprintf(report->engine, sizeof report->engine, "MUMPS factors, refined by CG");
    goal->settled = goal->crude ? 0.0 : settled;
    if (direct->shift > 0.0) /* errors of such factors do not show how close rounding is */
        goal->compensated = 1;
    OST_TRY(ost_cg_solve(&system, &factors, f, u, goal, report));
    return direct->shift > 0.0 && !goal->crude ? check_shifted(direct, report) : OST_SUCCESS;
}

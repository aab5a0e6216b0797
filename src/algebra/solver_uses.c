/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/precondition.h"
#include "algebra/solver_data.h"
#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>
#include <string.h>

/* What the current strategy is used for beside solving. */

void ost_solver_system(const OstSolver *solver, OstCgSystem *system, OstPreconditioner *preconditioner)
{
    *system = (OstCgSystem){.matrix = solver->matrix};
    *preconditioner = (OstPreconditioner){.data = solver->plain, .apply = ost_smoothed_aggregation_apply};
    if (solver->metric)
        ost_metric_system(solver->metric, system, preconditioner);
    if (solver->direct)
        ost_direct_system(solver->direct, system, preconditioner);
}

static OstStatus solve_unsymmetric(OstSolver *solver, const OstFurtherPart *further, double relative, const double *f,
                                   double *u, OstSolveReport *report)
{
    OstCgSystem system;
    OstPreconditioner preconditioner;
    if (solver->method == OST_METHOD_AUTO)
        return OST_RAISE(solver->ctx, OST_NOT_CONVERGED, "no strategy of this solver is left");
    ost_solver_system(solver, &system, &preconditioner);
    report->method = solver->method;
    snprintf(report->engine, sizeof report->engine, "AztecOO GMRES, %s", solver->direct ? "MUMPS factors" : "ML cycle");
    return ost_gmres_solve(&system, &preconditioner, further, relative, f, u, &report->iterations,
                           &report->relative_residual);
}

OstStatus ost_solver_solve_unsymmetric(OstSolver *solver, const OstFurtherPart *further, double relative,
                                       const double *f, double *u, OstSolveReport *report)
{
    memset(report, 0, sizeof *report);
    report->plan = solver->plan;
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    const double start = ost_seconds();
    const OstStatus status = solve_unsymmetric(solver, further, relative, f, u, report);
    report->setup_seconds = solver->setup_seconds;
    report->solve_seconds = ost_seconds() - start;
    ost_ledger_leave(solver->ctx);
    return status;
}

OstStatus ost_solver_error(OstSolver *solver, double missing, const double *residual, double *error, int *found)
{
    OstCgSystem system;
    OstPreconditioner preconditioner;
    *found = 0;
    if (solver->method == OST_METHOD_AUTO || !(solver->smallest > 0.0))
        return OST_SUCCESS;
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    ost_solver_system(solver, &system, &preconditioner);
    const OstStatus status =
        ost_error_of_residual(&system, &preconditioner, solver->smallest, missing, residual, error, found);
    ost_ledger_leave(solver->ctx);
    return status;
}

OstStatus ost_solver_precondition(OstSolver *solver, const double *r, double *z, int *found)
{
    OstCgSystem system;
    OstPreconditioner preconditioner;
    double *scaled = NULL;
    *found = solver->method != OST_METHOD_AUTO;
    if (!*found)
        return OST_SUCCESS;
    OST_TRY(ost_agree(solver->ctx, OST_NEW(solver->ctx, &scaled, 3 * (size_t)solver->matrix->rows)));
    ost_solver_system(solver, &system, &preconditioner);
    const OstStatus status = ost_precondition(&system, &preconditioner, r, scaled, z);
    OST_FREE(scaled);
    return status;
}

int ost_solver_shares(const OstSolver *solver)
{
    return solver->metric != NULL;
}

OstStatus ost_solver_share(const OstSolver *solver, OstSolver **shared)
{
    OST_TRY(OST_NEW(solver->ctx, shared, 1));
    **shared = *solver;
    (*shared)->is_shared = 1;
    (*shared)->aim = (OstSolverAim){0};
    return OST_SUCCESS;
}

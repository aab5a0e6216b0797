/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/error.h"
#include "algebra/saddle/unsymmetric.h"
#include "algebra/solver.h"
#include "algebra/solver_data.h"
#include "core/error.h"

#include <stdio.h>
#include <string.h>

/* What the strategies of solver.c do beside conjugate gradients for one symmetric matrix. */

void ost_solver_system(const OstSolver *solver, OstCgSystem *system, OstPreconditioner *preconditioner)
{
    *system = (OstCgSystem){.matrix = solver->matrix};
    *preconditioner = (OstPreconditioner){.data = solver->plain, .apply = ost_smoothed_aggregation_apply};
    if (solver->metric)
        ost_metric_system(solver->metric, system, preconditioner);
    if (solver->direct)
        ost_direct_system(solver->direct, system, preconditioner);
}

int ost_solver_has_preconditioner(const OstSolver *solver)
{
    return solver->plain || solver->metric || solver->direct;
}

/* Makes solver->whole, or leaves it NULL where memory does not allow it or rounding. */
static OstStatus factor_both(OstSolver *solver, const OstCoupling *coupling)
{
    if (solver->whole)
        return OST_SUCCESS;
    ost_ledger_enter(solver->ctx, OST_LEDGER_HIERARCHY);
    const OstStatus status =
        ost_saddle_factors_create(solver->matrix, coupling, solver->options.factor_memory, &solver->whole);
    ost_ledger_leave(solver->ctx);
    if (status != OST_SUCCESS)
        ost_log(solver->ctx, OST_LOG_VERBOSE, "solver: no factors of both equations: %s", ost_error_text(solver->ctx));
    return status == OST_OUT_OF_MEMORY || status == OST_NOT_CONVERGED || status == OST_LIMIT_EXCEEDED ? OST_SUCCESS
                                                                                                      : status;
}

OstStatus ost_solver_factor_direct(OstSolver *solver, double memory)
{
    const OstCoupling *coupling = solver->aim.coupling;
    const OstStatus status = ost_direct_create(solver->matrix, memory, &solver->direct);
    if (!coupling || (status != OST_NOT_CONVERGED && status != OST_INVALID_INPUT))
        return status;
    OST_TRY(factor_both(solver, coupling));
    return solver->whole && ost_saddle_factors_negative(solver->whole) == 0 ? OST_SUCCESS : status;
}

OstStatus ost_solver_factor_indefinite(OstSolver *solver, const OstCoupling *coupling, int *found)
{
    ost_saddle_factors_destroy(&solver->whole); /* of other values, perhaps */
    OST_TRY(factor_both(solver, coupling));
    *found = solver->whole != NULL;
    return OST_SUCCESS;
}

OstStatus ost_solver_count_negative(OstSolver *solver, const OstCoupling *coupling, OstGlobal *negative, int *known)
{
    OST_TRY(ost_solver_factor_indefinite(solver, coupling, known));
    *negative = *known ? ost_saddle_factors_negative(solver->whole) : 0;
    if (!solver->direct || !coupling)
        ost_saddle_factors_destroy(&solver->whole);
    return OST_SUCCESS;
}

OstStatus ost_solver_improve_mixed(OstSolver *solver, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    OstPreconditioner preconditioner;
    OstCgSystem system;
    ost_solver_system(solver, &system, &preconditioner);
    if (solver->metric)
        ost_metric_report(solver->metric, report);
    if (solver->direct) /* whose factors serve where those of both equations do not fit */
        OST_TRY(factor_both(solver, solver->saddle->coupling));
    if (solver->whole) {
        snprintf(report->engine, sizeof report->engine, "MUMPS factors of both equations");
        return ost_saddle_correct(&system, solver->whole, solver->saddle, f, u, goal, report);
    }
    snprintf(report->engine, sizeof report->engine, "Bramble-Pasciak CG, %s",
             solver->direct ? "MUMPS factors" : "ML cycle");
    return ost_saddle_solve(&system, &preconditioner, solver->saddle, f, u, goal, report);
}

static OstStatus find_error(OstSolver *solver, double missing, const OstSaddle *saddle, const double *r_u, double *e_u,
                            int *found)
{
    OstPreconditioner preconditioner;
    OstCgSystem system;
    if (solver->whole)
        return ost_saddle_factors_solve(solver->whole, r_u, saddle->g, e_u, saddle->p);
    ost_solver_system(solver, &system, &preconditioner);
    if (missing < 1.0)
        return ost_saddle_iterated_error(&system, &preconditioner, saddle, solver->scale, missing, r_u, e_u, found);
    OST_TRY(ost_saddle_error(&system, &preconditioner, saddle, solver->scale, r_u, e_u));
    for (size_t i = 0; i < 3 * (size_t)solver->matrix->rows; i++)
        e_u[i] /= solver->smallest;
    for (size_t i = 0; i < (size_t)saddle->coupling->rows; i++)
        saddle->p[i] /= solver->smallest;
    return OST_SUCCESS;
}

OstStatus ost_solver_mixed_error(OstSolver *solver, double missing, const OstSaddle *saddle, const double *r_u,
                                 double *e_u, int *found)
{
    *found = solver->whole || (ost_solver_has_preconditioner(solver) && (missing < 1.0 || solver->smallest > 0.0));
    if (!*found)
        return OST_SUCCESS;
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    const OstStatus status = find_error(solver, missing, saddle, r_u, e_u, found);
    ost_ledger_leave(solver->ctx);
    return status;
}

int ost_solver_mixed_is_poor(const OstSolver *solver)
{
    static const double poor = 3.0; /* a healthy solve ends with 1.2 to 2.5 */
    return !solver->whole && solver->scale > poor;
}

static OstStatus apply_factors(void *data, const double *r, double *z)
{
    return ost_saddle_factors_solve(data, r, NULL, z, NULL);
}

static OstStatus solve_unsymmetric(OstSolver *solver, const OstSaddle *saddle, const OstFurtherPart *further,
                                   double relative, const double *f, double *u, OstSolveReport *report)
{
    OstCgSystem system;
    OstPreconditioner preconditioner;
    int *iterations = &report->iterations;
    double *residual = &report->relative_residual;
    if (saddle && solver->method == OST_METHOD_DIRECT)
        OST_TRY(factor_both(solver, saddle->coupling));
    if (!ost_solver_has_preconditioner(solver) && !solver->whole)
        return OST_RAISE(solver->ctx, OST_NOT_CONVERGED, "no strategy of this solver is left");
    ost_solver_system(solver, &system, &preconditioner);
    if (solver->whole && !saddle) {
        system = (OstCgSystem){.matrix = solver->matrix};
        preconditioner = (OstPreconditioner){.data = solver->whole, .apply = apply_factors};
    }
    report->method = solver->whole ? OST_METHOD_DIRECT : solver->method;
    snprintf(report->engine, sizeof report->engine, "AztecOO GMRES, %s",
             report->method == OST_METHOD_DIRECT ? "MUMPS factors" : "ML cycle");
    if (saddle)
        return ost_saddle_solve_unsymmetric(&system, &preconditioner, solver->whole, saddle, further, relative, f, u,
                                            iterations, residual);
    return ost_gmres_solve(&system, &preconditioner, further, relative, f, u, iterations, residual);
}

OstStatus ost_solver_solve_unsymmetric(OstSolver *solver, const OstSaddle *saddle, const OstFurtherPart *further,
                                       double relative, const double *f, double *u, OstSolveReport *report)
{
    memset(report, 0, sizeof *report);
    report->plan = solver->plan;
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    const double start = ost_seconds();
    const OstStatus status = solve_unsymmetric(solver, saddle, further, relative, f, u, report);
    report->setup_seconds = solver->setup_seconds;
    report->solve_seconds = ost_seconds() - start;
    ost_ledger_leave(solver->ctx);
    return status;
}

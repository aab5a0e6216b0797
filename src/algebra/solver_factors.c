/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_data.h"
#include "algebra/solver_options.h"
#include "core/error.h"

/* When a strategy has failed, are factors of the whole matrix the better next one? */

/* Operations of a factorisation, for each nonzero, in whose time STRONG is found to fail, by 40 iterations, as it
 * mostly does after METRIC: stiff inclusions of 280,000 unknowns take 1.3e5 and 220 s, STRONG 246 s; slivers of
 * 86,000 3.8e4 and 7.9 s, STRONG 9.3 s (E3 x 1e6, 0.999 of the border). */
static const double of_trial = 1e5;

/* A mixed form's factors, of A and of both equations, over those of A. */
static const double of_both = 4.0;

/* Factors of a coarse level that take more of the memory of all factors than this are as dear, and leave iterations. */
static const double of_two_level = 0.7;

static OstStatus foretell(OstSolver *solver)
{
    ost_ledger_enter(solver->ctx, OST_LEDGER_HIERARCHY);
    const OstStatus status = ost_mumps_foretell(solver->matrix, solver->options.factor_memory, &solver->factors);
    ost_ledger_leave(solver->ctx);
    if (solver->aim.coupling)
        solver->factors.operations *= of_both;
    solver->fits = status == OST_SUCCESS;
    if (solver->fits)
        ost_log(solver->ctx, OST_LOG_VERBOSE,
                "solver: factors would take %.3g MiB and %.2g operations for each nonzero",
                solver->factors.bytes / 1048576.0, solver->factors.operations / solver->nonzeros);
    return status == OST_OUT_OF_MEMORY || status == OST_LIMIT_EXCEEDED ? OST_SUCCESS : status;
}

OstStatus ost_solver_next(OstSolver *solver, OstMethod *next)
{
    *next = (OstMethod)(solver->method + 1);
    if (solver->method != OST_METHOD_METRIC || solver->repeated || solver->fine)
        return OST_SUCCESS;
    OST_TRY(foretell(solver));
    if (solver->fits && solver->factors.operations < of_trial * solver->nonzeros)
        *next = OST_METHOD_DIRECT;
    return OST_SUCCESS;
}

/* 0: there is no such rule, or the user's is stricter. */
static double most_of_two_level(const OstSolver *solver, OstMethod method)
{
    const double allowed = solver->options.factor_memory, most = of_two_level * solver->factors.bytes;
    return method == OST_METHOD_TWO_LEVEL && solver->fits && !(allowed > 0.0 && allowed < most) ? most : 0.0;
}

void ost_solver_learned_options(const OstSolver *solver, OstMethod method, OstSolverOptions *options)
{
    const double most = most_of_two_level(solver, method);
    OstSolverOptions planned = solver->plan.options;
    planned.patches = solver->fine ? 1 + solver->precise : 0;
    planned.precise = solver->fine ? 2 : solver->precise;
    planned.fine = solver->fine && !solver->geometry.coarse;
    if (most > 0.0)
        planned.factor_memory = most;
    ost_solver_strategy_options(&planned, method, options);
}

OstStatus ost_solver_explain_memory(const OstSolver *solver, const OstSolverOptions *options, OstStatus status)
{
    if (status != OST_OUT_OF_MEMORY || !(most_of_two_level(solver, options->method) > 0.0))
        return status;
    return OST_RAISE(solver->ctx, OST_OUT_OF_MEMORY,
                     "factors of its coarse level would take over %.0f %% of the memory of all factors, which fit",
                     100.0 * of_two_level);
}

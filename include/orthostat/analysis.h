/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ANALYSIS_H
#define ORTHOSTAT_ANALYSIS_H

#include "orthostat/problem.h"
#include "orthostat/result.h"

OST_API_BEGIN

/* A static analysis: a problem, a solver, and the strategy that suits the problem. What does not depend on the load
 * (checked supports, stiffness, the solver's hierarchy or factors) is made once and serves every solve. */
typedef struct OstAnalysis OstAnalysis;

/* Collective. The problem outlives the analysis and is not changed meanwhile, but for its load
 * (ost_problem_set_load). */
OstStatus ost_analysis_create(OstProblem *problem, const OstSolverOptions *options, OstAnalysis **analysis);
void ost_analysis_destroy(OstAnalysis **analysis);

/* Collective. Solves for the problem's load. The first time, motions that nothing constrains are looked for, stiffness
 * and hierarchy are made. Checks the load, solves, checks the answer, and adds the fields asked for (bits of
 * OstOutputFieldBit). Raises OST_INVALID_INPUT or OST_CHECK_FAILED with all that speaks against solving or against the
 * answer, OST_NOT_CONVERGED where the solver stopped early; where result->reached, the result is filled then too, but
 * is not an answer. The caller destroys the result in any case; mesh and field outlive it. */
OstStatus ost_analysis_solve(OstAnalysis *analysis, unsigned fields, OstResult **result);

/* Collective. A single solve in the least memory: matrix and solver are gone before the answer is checked. */
OstStatus ost_problem_solve(OstProblem *problem, const OstSolverOptions *options, unsigned fields, OstResult **result);

/* Collective. A dry run: everything that is checked before a solver is built, and nothing solved. What is refused here
 * is refused by ost_problem_solve in the same words. */
OstStatus ost_problem_dry_run(OstProblem *problem, const OstSolverOptions *options);

OST_API_END

#endif

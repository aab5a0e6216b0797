/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_STRATEGY_H
#define ORTHOSTAT_SOLVE_STRATEGY_H

#include "guard/guard.h"
#include "orthostat/analysis.h"
#include "problem/problem.h"

/* A way to solve a problem. One more is one more file, and a line in analysis.c where it is picked. Each function is
 * collective and gets the analysis' own work space, of the strategy's making. */
typedef struct OstStrategy {
    /* Makes what solves for any load will share, as far as it is not there, and what this one needs; adds to `before`
     * what speaks against solving. */
    OstStatus (*prepare)(OstAnalysis *analysis, OstVerdict *before);

    /* Fills result->displacement, result->solve and result->reached, and what the answer is measured by. */
    OstStatus (*solve)(OstAnalysis *analysis, OstResult *result, OstSolvedFor *solved_for);

    /* Frees the work space. */
    void (*release)(OstAnalysis *analysis);
} OstStrategy;

struct OstAnalysis {
    OstContext *ctx;
    OstProblem *problem;
    OstSolverOptions options;
    const OstStrategy *strategy;
    void *work; /* the strategy's; NULL until prepared */
};

extern const OstStrategy ost_linear_strategy; /* linear.c */

#endif

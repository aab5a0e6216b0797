/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_STRATEGY_H
#define ORTHOSTAT_ALGEBRA_STRATEGY_H

#include "algebra/krylov/refine.h"
#include "algebra/matrix/geometry.h"

/* A solver strategy: a method, set up for one matrix. */
typedef struct OstStrategy OstStrategy;

/* Collective. Makes *strategy (NULL, or an earlier one) the method that `options` names. METRIC's hierarchy is kept for
 * STRONG; anything else is destroyed before the new one is built. On failure *strategy is NULL. */
OstStatus ost_strategy_prepare(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                               const OstSolverOptions *options, OstStrategy **strategy);
void ost_strategy_destroy(OstStrategy **strategy);
OstMethod ost_strategy_method(const OstStrategy *strategy);

/* Collective. Improves u as ost_cg_solve; also fills the report's engine, levels and complexity. */
OstStatus ost_strategy_improve(OstStrategy *strategy, const double *f, double *u, OstGoal *goal,
                               OstSolveReport *report);

#endif

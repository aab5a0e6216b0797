/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_STRATEGY_H
#define ORTHOSTAT_ALGEBRA_STRATEGY_H

#include "algebra/krylov/refine.h"
#include "algebra/matrix/geometry.h"

/* A solver strategy: a method, built and ready to work. */
typedef struct OstStrategy OstStrategy;

/* Collective. Makes *strategy the method that `options` names. What is there already serves where it can (METRIC's
 * hierarchy becomes STRONG's) and is destroyed before anything new is built. On failure *strategy is NULL. */
OstStatus ost_strategy_prepare(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                               const OstSolverOptions *options, OstStrategy **strategy);
void ost_strategy_destroy(OstStrategy **strategy);
OstRecipe ost_strategy_recipe(const OstStrategy *strategy);

/* Collective. Improves u, as ost_refine; fills the report's engine, levels, complexity and condition estimate. */
OstStatus ost_strategy_improve(OstStrategy *strategy, const double *f, double *u, OstGoal *goal,
                               OstSolveReport *report);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_STRATEGY_H
#define ORTHOSTAT_ALGEBRA_STRATEGY_H

#include "algebra/krylov/refine.h"
#include "algebra/matrix/geometry.h"

/* One rung of the ladder: a recipe, built and ready to work. */
typedef struct OstStrategy OstStrategy;

/* Collective. Makes *rung the recipe in `options`: what stood there serves where it can (strong smoothing takes over
 * the hierarchy of METRIC) and is destroyed before anything new is built. On failure it is NULL. */
OstStatus ost_strategy_prepare(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                               const OstSolverOptions *options, OstStrategy **rung);
void ost_strategy_destroy(OstStrategy **rung);
OstRecipe ost_strategy_recipe(const OstStrategy *rung);

/* Collective. Improves u, as ost_refine; fills the report's levels, complexity and condition estimate. */
OstStatus ost_strategy_improve(OstStrategy *rung, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_RUNG_H
#define ORTHOSTAT_ALGEBRA_RUNG_H

#include "algebra/krylov/refine.h"
#include "algebra/solver.h"

/* One rung of the ladder: a recipe, built and ready to work. */
typedef struct OstRung OstRung;

/* Collective. Makes *rung the recipe in `options`: what stood there serves where it can (strong smoothing takes over
 * the hierarchy of METRIC) and is destroyed before anything new is built. On failure it is NULL. */
OstStatus ost_rung_stand(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                         const OstSolverOptions *options, OstRung **rung);
void ost_rung_destroy(OstRung **rung);
OstRecipe ost_rung_recipe(const OstRung *rung);

/* Collective. Improves u, as ost_refine; fills the report's levels, complexity and condition estimate. */
OstStatus ost_rung_work(OstRung *rung, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_QUADRATIC_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_QUADRATIC_H

#include "algebra/matrix/columns.h"
#include "algebra/matrix/geometry.h"
#include "algebra/multigrid/smoother.h"

/* The level of quadratic tets above those of the linear ones (p-multigrid): the smoother works on the quadratic matrix,
 * the correction comes from linear tets of the same body. Aggregating the quadratic matrix itself takes more iterations
 * and several times as long.
 *
 * The correction is interpolated without a matrix, in scaled unknowns: P' = S_q^-T P S_l^T, where P gives a quadratic
 * node the weighted sum of its parents. */
typedef struct OstQuadraticLevel {
    OstLevelMatrix *matrix;
    OstSmoother *smoother;
    OstCoarseSpace space; /* what it points to, and the scalings, are the caller's and outlive the level */
    const OstScaling *quadratic, *linear;
    double *fine, *coarse; /* unscaled: 3 × quadratic rows and 3 × linear columns */
} OstQuadraticLevel;

/* Collective. `matrix` and `graph` are those of the quadratic tets and are not kept. */
OstStatus ost_quadratic_level_create(const OstBlockMatrix *matrix, const OstMetricGraph *graph,
                                     const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
                                     const OstSolverOptions *options, OstQuadraticLevel **level);
void ost_quadratic_level_destroy(OstQuadraticLevel **level);

/* Collective over neighbours. x = P' c, and c = P'ᵀ x; x has 3 × quadratic rows numbers, c 3 × linear rows. */
OstStatus ost_quadratic_level_prolong(const OstQuadraticLevel *level, const double *c, double *x);
OstStatus ost_quadratic_level_restrict(const OstQuadraticLevel *level, const double *x, double *c);

/* The same with OST_COLUMNS vectors; `room` has 3 × linear columns. */
OstStatus ost_quadratic_level_prolong_columns(const OstQuadraticLevel *level, const OstColumns *c, OstColumns *room,
                                              OstColumns *x);
OstStatus ost_quadratic_level_restrict_columns(const OstQuadraticLevel *level, const OstColumns *x, OstColumns *room,
                                               OstColumns *c);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_QUADRATIC_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_QUADRATIC_H

#include "algebra/multigrid/cycle.h"
#include "algebra/multigrid/interpolation.h"

/* One level of quadratic tets above the cycle of the linear ones (p-multigrid): smooths on the quadratic matrix, and
 * corrects by linear tets of the same body, solved roughly by a K-cycle. Aggregating the quadratic matrix itself takes
 * more iterations and several times as long. */
typedef struct OstQuadraticLevel {
    OstContext *ctx;
    OstLevelMatrix *matrix;
    OstSmoother *smoother;
    OstInterpolation *interpolation;
    OstCycle *linear; /* the caller's */
    double *solution; /* with room for ghosts */
    double *residual;
    double *right_side, *correction; /* of the linear tets */
} OstQuadraticLevel;

/* Collective. `matrix` is that of quadratic tets, `graph` its nodes (neither is kept). The scalings, the coarse space
 * and the cycle stay the caller's and outlive the level. */
OstStatus ost_quadratic_level_create(const OstBlockMatrix *matrix, const OstMetricGraph *graph,
                                     const OstCoarseSpace *space, const OstScaling *quadratic,
                                     const OstScaling *linear_scaling, OstCycle *linear,
                                     const OstSolverOptions *options, OstQuadraticLevel **level);
void ost_quadratic_level_destroy(OstQuadraticLevel **level);

/* Collective. z = one cycle from zero for A z = r; 3 × quadratic rows each. */
OstStatus ost_quadratic_level_apply(OstQuadraticLevel *level, const double *r, double *z);

#endif

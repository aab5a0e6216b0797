/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_QUADRATIC_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_QUADRATIC_H

#include "algebra/multigrid/interpolation.h"
#include "algebra/multigrid/smoother.h"

/* The level of quadratic tets above those of the linear ones (p-multigrid): the smoother works on the quadratic matrix,
 * the correction comes from linear tets of the same body. Aggregating the quadratic matrix itself takes more iterations
 * and several times as long. */
typedef struct OstQuadraticLevel {
    OstLevelMatrix *matrix;
    OstSmoother *smoother;
    OstInterpolation *interpolation;
} OstQuadraticLevel;

/* Collective. `matrix` and `graph` are those of the quadratic tets and are not kept. The scalings and the coarse space
 * stay the caller's and must outlive the level. */
OstStatus ost_quadratic_level_create(const OstBlockMatrix *matrix, const OstMetricGraph *graph,
                                     const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
                                     const OstSolverOptions *options, OstQuadraticLevel **level);
void ost_quadratic_level_destroy(OstQuadraticLevel **level);

#endif

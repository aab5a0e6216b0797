/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_LEVELS_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_LEVELS_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/level_matrix.h"
#include "algebra/level/prolongator.h"
#include "algebra/multigrid/smoother.h"

/* What smoothed aggregation makes of a matrix: matrices of all levels, prolongators between them, graphs of the levels'
 * nodes. Level 0 is the finest. */
typedef struct OstMetricLevels {
    int count;
    OstLevelMatrix *matrix[OST_MAX_LEVELS];
    OstProlongator *prolongator[OST_MAX_LEVELS]; /* [l]: from level l + 1 to level l */
    OstSmoother *smoother[OST_MAX_LEVELS];       /* of all but the last level */
    OstMetricGraph *graph[OST_MAX_LEVELS];       /* of the last level */
    OstDoubleMatrix *coarsest;                   /* the last of the matrices in double precision */
} OstMetricLevels;

/* Collective. Of S A S^T, whose near-null space are `modes` (6 columns of 3 × rows); they and the graph are taken over;
 * matrix and scaling outlive the levels, and a scaling of NULL is the identity. A matrix no larger than
 * options->coarsest_unknowns stays the only level, and so does one that has nothing to aggregate; `coarsest` is then a
 * view of it. */
OstStatus ost_metric_levels_create(const OstBlockMatrix *matrix, const OstScaling *scaling, double **modes,
                                   OstMetricGraph **finest_graph, const OstSolverOptions *options,
                                   OstMetricLevels *levels);
void ost_metric_levels_clear(OstMetricLevels *levels);

#endif

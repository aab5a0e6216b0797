/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_LEVELS_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_LEVELS_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/level_matrix.h"
#include "algebra/level/prolongator.h"
#include "algebra/multigrid/smoother.h"
#include "algebra/multigrid/vertices.h"

/* The levels of smoothed aggregation: their matrices, and the prolongators and smoothers. Level 0 is the finest. */
typedef struct OstLevels {
    int count;
    OstLevelMatrix *matrix[OST_MAX_LEVELS];
    OstProlongator *prolongator[OST_MAX_LEVELS]; /* [l]: from level l + 1 to level l */
    OstSmoother *smoother[OST_MAX_LEVELS];       /* of all but the last level */
    OstMetricGraph *graph[OST_MAX_LEVELS];       /* of the last level; of the others only during construction */
    OstDoubleMatrix *coarsest;                   /* the last level's matrix in double precision */
    int flat;                                    /* is the last level that of the columns of a plate? */
} OstLevels;

/* Collective. The levels of S A S^T (of A, if scaling is NULL), whose near-null space is `modes`: 6 columns of 3 × rows
 * numbers. Takes over modes and graph, and empties the caller's; matrix and scaling must outlive the levels. A matrix
 * of at most options->coarsest_unknowns, or without anything to aggregate, stays the only level; `coarsest` is then a
 * view of it. The second level is that of `vertices`, which is emptied, or of aggregates where that is NULL. */
OstStatus ost_levels_create(const OstBlockMatrix *matrix, const OstScaling *scaling, double **modes,
                            OstMetricGraph **finest_graph, OstVertexSpace *vertices, const OstSolverOptions *options,
                            OstLevels *levels);
void ost_levels_clear(OstLevels *levels);

#endif

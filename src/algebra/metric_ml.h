/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_ML_H
#define ORTHOSTAT_ALGEBRA_METRIC_ML_H

#include "algebra/metric_graph.h"
#include "algebra/metric_operator.h"

/* What ML's smoothed aggregation made of a matrix: matrices of all levels, prolongators between them, graphs of the
 * levels' nodes. Level 0 is the finest. */
typedef struct OstMetricLevels {
    int count;
    OstMetricOperator *matrix[OST_MAX_LEVELS];
    OstMetricOperator *prolongator[OST_MAX_LEVELS]; /* [l]: from level l + 1 to level l */
    OstMetricGraph *graph[OST_MAX_LEVELS];
} OstMetricLevels;

/* Collective. `modes` are the near-null space of `matrix` (6 columns of 3 × rows). ML's own copies are freed before
 * this returns. A matrix no larger than options->coarsest_unknowns stays the only level. */
OstStatus ost_metric_levels_create(const OstBlockMatrix *matrix, const double *modes, OstMetricGraph **finest_graph,
                                   const OstSolverOptions *options, OstMetricLevels *levels);
void ost_metric_levels_clear(OstMetricLevels *levels);

#endif

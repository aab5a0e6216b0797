/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_SMOOTHED_AGGREGATION_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_SMOOTHED_AGGREGATION_H

#include "algebra/matrix/geometry.h"

/* ML's smoothed aggregation as it comes, for the method `plain`: aggregates of ML's own within each rank, Chebyshev
 * smoothing, a V-cycle, and a direct solve through Amesos on the coarsest level. */
typedef struct OstSmoothedAggregation OstSmoothedAggregation;

/* Collective. Builds the hierarchy; the matrix stays the caller's and is used until it is destroyed. */
OstStatus ost_smoothed_aggregation_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                                          const OstSolverOptions *options, OstSmoothedAggregation **hierarchy);
void ost_smoothed_aggregation_destroy(OstSmoothedAggregation **hierarchy);

/* Collective. z = one cycle from zero for A z = r, for a preconditioner: `data` is the hierarchy. */
OstStatus ost_smoothed_aggregation_apply(void *data, const double *r, double *z);

/* Local. Fills the report's levels and complexity. */
void ost_smoothed_aggregation_report(const OstSmoothedAggregation *hierarchy, OstSolveReport *report);

#endif

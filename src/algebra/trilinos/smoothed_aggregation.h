/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_SMOOTHED_AGGREGATION_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_SMOOTHED_AGGREGATION_H

#include "algebra/matrix/geometry.h"

/* The method `plain`: ML's own smoothed aggregation, with aggregates within each rank, Chebyshev smoothing, a V-cycle,
 * and a direct solve by Amesos on the coarsest level. */
typedef struct OstSmoothedAggregation OstSmoothedAggregation;

/* Collective. Builds the hierarchy. The matrix stays the caller's and must outlive it. */
OstStatus ost_smoothed_aggregation_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                                          const OstSolverOptions *options, OstSmoothedAggregation **hierarchy);
void ost_smoothed_aggregation_destroy(OstSmoothedAggregation **hierarchy);

/* Collective. z = one cycle from zero for A z = r; as OstPreconditioner's `apply`, with the hierarchy as `data`. */
OstStatus ost_smoothed_aggregation_apply(void *data, const double *r, double *z);

/* Local. Fills the report's levels and complexity. */
void ost_smoothed_aggregation_report(const OstSmoothedAggregation *hierarchy, OstSolveReport *report);

#endif

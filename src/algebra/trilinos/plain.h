/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_PLAIN_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_PLAIN_H

#include "algebra/krylov/refine.h"
#include "algebra/matrix/geometry.h"

/* The plain recipe: AztecOO's conjugate gradients, preconditioned by a V-cycle of ML's smoothed aggregation as it
 * comes: aggregates of ML's own within each rank, Chebyshev smoothing, a direct solve on the coarsest level. */
typedef struct OstPlain OstPlain;

/* Collective. Builds the hierarchy; the matrix stays the caller's and is used until ost_plain_destroy. */
OstStatus ost_plain_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                           const OstSolverOptions *options, OstPlain **plain);
void ost_plain_destroy(OstPlain **plain);

/* Collective. As ost_aztec_solve; fills the report's levels and complexity. */
OstStatus ost_plain_solve(OstPlain *plain, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif

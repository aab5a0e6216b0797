/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_DIRECT_DIRECT_H
#define ORTHOSTAT_ALGEBRA_DIRECT_DIRECT_H

#include "algebra/krylov/refine.h"

/* The direct recipe: MUMPS factors the scaled matrix, and conjugate gradients preconditioned by its factors bring the
 * residual down to what was requested, which one solve alone does not (1e-6 on very uneven stiffness). Where rounding
 * makes the matrix, or its factors, indefinite, those of the matrix and at most 5e-13 on its diagonal of ones
 * lead to the solution as well, if there is one. */
typedef struct OstDirect OstDirect;

/* Collective. Factors in at most `memory` bytes, as ost_mumps_create; the matrix stays the caller's and is used until
 * ost_direct_destroy. */
OstStatus ost_direct_create(const OstBlockMatrix *matrix, double memory, OstDirect **direct);
void ost_direct_destroy(OstDirect **direct);

/* Collective. As ost_cg_solve; fills the report's levels, complexity and condition estimate. Raises OST_NOT_CONVERGED
 * where more than rounding makes the matrix indefinite: no digit of u is left. */
OstStatus ost_direct_solve(OstDirect *direct, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_DIRECT_DIRECT_H
#define ORTHOSTAT_ALGEBRA_DIRECT_DIRECT_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/krylov/refine.h"

/* The direct method: MUMPS factors the scaled matrix, and CG preconditioned by the factors reduces the residual to the
 * one requested (a single solve leaves 1e-6 on very uneven stiffness). If rounding makes the factorisation fail, up to
 * 5e-13 is added to the scaled diagonal, and CG removes the effect. */
typedef struct OstDirect OstDirect;

/* Collective. Factors in at most `memory` bytes, as ost_mumps_create; the matrix stays the caller's and is used until
 * ost_direct_destroy. */
OstStatus ost_direct_create(const OstBlockMatrix *matrix, double memory, OstDirect **direct);
void ost_direct_destroy(OstDirect **direct);

/* Local. What conjugate gradients iterate on, and the factors; both live as long as `direct`. */
void ost_direct_system(const OstDirect *direct, OstCgSystem *system, OstPreconditioner *factors);

/* Collective. As ost_cg_solve; also fills the report's engine, levels and complexity. Raises OST_NOT_CONVERGED if the
 * diagonal was shifted and u has a relative error of 0.1 or more: the matrix is singular or indefinite. */
OstStatus ost_direct_solve(OstDirect *direct, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif

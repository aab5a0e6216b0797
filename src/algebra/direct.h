/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_DIRECT_H
#define ORTHOSTAT_ALGEBRA_DIRECT_H

#include "algebra/block_matrix.h"
#include "orthostat/solver.h"

/* The direct recipe: MUMPS factors the scaled matrix, and conjugate gradients preconditioned by its factors bring the
 * residual down to what was requested, which one solve alone does not (1e-6 on very uneven stiffness). */
typedef struct OstDirect OstDirect;

/* Collective. Factors; the matrix stays the caller's and is used until ost_direct_destroy. Raises OST_NOT_CONVERGED if
 * the matrix is singular or indefinite, OST_LIMIT_EXCEEDED, OST_OUT_OF_MEMORY, OST_LIBRARY_FAILED with MUMPS's code. */
OstStatus ost_direct_create(const OstBlockMatrix *matrix, OstDirect **direct);
void ost_direct_destroy(OstDirect **direct);

/* Collective. As ost_solver_solve; fills all of the report but recipe and seconds. */
OstStatus ost_direct_solve(OstDirect *direct, const double *f, double *u, const OstSolverOptions *options,
                           OstSolveReport *report);

#endif

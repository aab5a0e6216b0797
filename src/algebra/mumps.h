/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MUMPS_H
#define ORTHOSTAT_ALGEBRA_MUMPS_H

#include "algebra/block_matrix.h"

/* MUMPS's factors of a symmetric positive definite block matrix. */
typedef struct OstMumps OstMumps;

/* Collective. Analyses and factors; nothing of the matrix is kept. Its diagonal blocks are expected to be of order 1
 * (OstScaling). Raises OST_NOT_CONVERGED if it is singular or indefinite, OST_LIMIT_EXCEEDED, OST_OUT_OF_MEMORY,
 * OST_LIBRARY_FAILED with MUMPS's code. */
OstStatus ost_mumps_create(const OstBlockMatrix *matrix, OstMumps **mumps);
void ost_mumps_destroy(OstMumps **mumps);

/* Collective. x = A^-1 b, 3 × rows numbers each. */
OstStatus ost_mumps_solve(OstMumps *mumps, const double *b, double *x);

#endif

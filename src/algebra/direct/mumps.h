/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_DIRECT_MUMPS_H
#define ORTHOSTAT_ALGEBRA_DIRECT_MUMPS_H

#include "algebra/level/double_matrix.h"

/* MUMPS's factors of a symmetric positive definite matrix of blocks. */
typedef struct OstMumps OstMumps;

/* Collective. Analyses and factors; nothing of the matrix is kept. Its diagonal blocks are expected to be of order 1
 * (OstScaling). Raises OST_OUT_OF_MEMORY, before it takes any, if the analysis foresees more than `memory` bytes over
 * all ranks, or than the machines have free where `memory` is 0; OST_NOT_CONVERGED if the matrix is singular or
 * indefinite, OST_LIMIT_EXCEEDED, OST_LIBRARY_FAILED with MUMPS's code. */
OstStatus ost_mumps_create(const OstDoubleMatrix *matrix, double memory, OstMumps **mumps);
/* Collective. The same of S A S^T, or of A where `scaling` is NULL. `shift` (or NULL): where the matrix is singular or
 * indefinite by no more than rounding makes it, the factors are those of the matrix with this added to its diagonal,
 * 5e-13 at most of the order of 1 that it is; 0 where it is definite. */
OstStatus ost_mumps_create_of_rows(const OstBlockMatrix *matrix, const OstScaling *scaling, double memory,
                                   double *shift, OstMumps **mumps);
void ost_mumps_destroy(OstMumps **mumps);

/* Collective. x = A^-1 b, size × rows numbers each. */
OstStatus ost_mumps_solve(OstMumps *mumps, const double *b, double *x);

#endif

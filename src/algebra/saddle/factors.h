/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_FACTORS_H
#define ORTHOSTAT_ALGEBRA_SADDLE_FACTORS_H

#include "algebra/matrix/block_matrix.h"
#include "algebra/saddle/coupling.h"

/* MUMPS's factors of both equations of a mixed form (coupling.h), scaled by their diagonals. They do not care whether A
 * is definite, nor what the Schur complement is like. Where C is 0, 1e-13 of what the Schur complement is taken for
 * stands in its place, as the mean pressure of an enclosed body is determined by nothing. */
typedef struct OstSaddleFactors OstSaddleFactors;

/* Collective. Factors in at most `memory` bytes, as ost_mumps_create; nothing is kept of the matrices. */
OstStatus ost_saddle_factors_create(const OstBlockMatrix *matrix, const OstCoupling *coupling, double memory,
                                    OstSaddleFactors **factors);
void ost_saddle_factors_destroy(OstSaddleFactors **factors);

/* Local. How many eigenvalues of A are negative on the displacements that obey the second equation; where C is not 0,
 * of A + B' C^-1 B: the stiffness without pressures. Such a body is not stable. */
OstGlobal ost_saddle_factors_negative(const OstSaddleFactors *factors);

/* Collective. u and p of A u + B' p = f, B u - C p = g, on 3 × rows of A and `rows` of the coupling. Output may be
 * input. */
OstStatus ost_saddle_factors_solve(const OstSaddleFactors *factors, const double *f, const double *g, double *u,
                                   double *p);

#endif

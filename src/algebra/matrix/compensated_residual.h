/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_COMPENSATED_RESIDUAL_H
#define ORTHOSTAT_ALGEBRA_MATRIX_COMPENSATED_RESIDUAL_H

#include "algebra/matrix/block_matrix.h"

/* Collective over neighbours. residual = f - A u as if summed in twice the precision and rounded once (Ogita, Rump,
 * Oishi, Accurate sum and dot product, SIAM J. Sci. Comput. 26, 2005, Dot2): what is left is u's own rounding. Some
 * ten times the cost of a product. u has room for 3 × columns numbers, and its ghosts are filled here. */
OstStatus ost_compensated_residual(const OstBlockMatrix *matrix, const double *f, double *u, double *residual);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_RESIDUAL_H
#define ORTHOSTAT_ALGEBRA_MATRIX_RESIDUAL_H

#include "algebra/matrix/block_matrix.h"

/* Collective over neighbours. residual = f - A u by compensated sums, as if computed in twice the precision and rounded
 * once (Ogita, Rump, Oishi, Accurate sum and dot product, SIAM J. Sci. Comput. 26, 2005, Dot2). Costs about ten
 * products A u. u has room for 3 × columns numbers; its ghosts are filled here. */
OstStatus ost_compensated_residual(const OstBlockMatrix *matrix, const double *f, double *u, double *residual);

/* Collective over neighbours. The same, in plain double precision unless `compensated`. */
OstStatus ost_residual(const OstBlockMatrix *matrix, const double *f, double *u, int compensated, double *residual);

#endif

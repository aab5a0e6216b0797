/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_TERM_ROUNDING_H
#define ORTHOSTAT_ALGEBRA_MATRIX_TERM_ROUNDING_H

#include "algebra/matrix/block_matrix.h"

/* Local. What double precision leaves unsaid of each component of A u, every term of it being rounded at random:
 * DBL_EPSILON times the root of the sum of their squares. u comes with its ghosts; `rounding` has 3 × rows numbers. */
void ost_term_rounding(const OstBlockMatrix *matrix, const double *u, double *rounding);

#endif

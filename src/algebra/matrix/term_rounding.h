/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_TERM_ROUNDING_H
#define ORTHOSTAT_ALGEBRA_MATRIX_TERM_ROUNDING_H

#include "algebra/matrix/block_matrix.h"

/* Local. The expected rounding error of each component of A u if its terms are rounded at random: DBL_EPSILON times the
 * root of the sum of their squares. The ghosts of u are set; `rounding` has 3 × rows numbers. */
void ost_term_rounding(const OstBlockMatrix *matrix, const double *u, double *rounding);

#endif

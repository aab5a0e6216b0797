/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_NUMBER_RANGE_H
#define ORTHOSTAT_GUARD_NUMBER_RANGE_H

#include "algebra/matrix/block_matrix.h"

/* Do stiffness and right-hand side (3 × rows) keep all computed numbers within double precision? Norms and energies are
 * sums of squares, which can hold 1e-308 to 1e308: displacements must stay within 1e-150 to 1e150, and so their
 * factors, loads and stiffness, within 1e-75 to 1e75. Beyond, a norm underflows to zero and a displacement of zero
 * would pass for an answer. Both are collective and raise OST_INVALID_INPUT with the number and what to do. A
 * right-hand side of zeros is fine. */
OstStatus ost_number_range_of_stiffness(const OstBlockMatrix *matrix, const char *where);
OstStatus ost_number_range_of_load(const OstBlockMatrix *matrix, const double *rhs, const char *where);

#endif

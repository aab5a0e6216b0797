/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_FOLD_H
#define ORTHOSTAT_ALGEBRA_MATRIX_FOLD_H

#include "algebra/matrix/block_matrix.h"

/* Local. Drops the blocks left of the diagonal, whose transposes are right of it: half the memory, and a quicker
 * product. Leaves a matrix as it is whose columns are not those of a symmetric one. */
OstStatus ost_block_matrix_fold(OstBlockMatrix *matrix);

/* Local. Brings them back, for those who change values in place. */
OstStatus ost_block_matrix_unfold(OstBlockMatrix *matrix);

#endif

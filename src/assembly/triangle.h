/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_TRIANGLE_H
#define ORTHOSTAT_ASSEMBLY_TRIANGLE_H

#include "algebra/matrix/block_matrix.h"

/* A symmetric matrix is summed in its upper triangle only: in each row from the diagonal to the end, ghost columns
 * included (columns of ghosts come last). */

/* Local. Zeroes the upper triangle. */
void ost_triangle_clear(OstBlockMatrix *matrix);

/* Local. Copies the upper triangle's owned columns, transposed, into the lower. */
OstStatus ost_triangle_mirror(OstBlockMatrix *matrix);

#endif

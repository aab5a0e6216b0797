/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_EXACT_H
#define ORTHOSTAT_ALGEBRA_METRIC_EXACT_H

#include "algebra/block_matrix.h"

/* A level's matrix in double precision, as the next level is made of it. Rows are complete; columns are local numbers,
 * owned ones first, then ghosts. */
typedef struct OstExactMatrix {
    OstContext *ctx;
    int size;     /* of a block, which is kept row by row: 3 or 6 */
    int borrowed; /* the arrays and the halo are a block matrix' own */
    OstLocal rows, columns;
    OstLocal *row_start, *column; /* columns ascend within a row */
    double *value;
    OstHalo *halo;
} OstExactMatrix;

/* Local. A view of a block matrix. */
OstStatus ost_exact_matrix_borrow(const OstBlockMatrix *matrix, OstExactMatrix **exact);
void ost_exact_matrix_destroy(OstExactMatrix **exact);

/* Local. The block on the diagonal of a row. */
double *ost_exact_matrix_diagonal(const OstExactMatrix *matrix, OstLocal row);

/* Local. Puts 1 on the diagonal where it is not positive, so that an unknown that the prolongator does not reach (a
 * mode its aggregate cannot show) does no harm. */
void ost_exact_matrix_mend_diagonal(OstExactMatrix *matrix);

#endif

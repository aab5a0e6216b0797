/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_DOUBLE_MATRIX_H
#define ORTHOSTAT_ALGEBRA_LEVEL_DOUBLE_MATRIX_H

#include "algebra/level/simd.h"
#include "algebra/matrix/scaling.h"

/* A level's matrix in double precision, as the next level is made of it. Rows are complete; columns are local numbers,
 * owned ones first, then ghosts. The finest one is the stiffness in scaled unknowns, whose blocks are made as they are
 * asked for: a copy of its own would be a fifth of a solver's memory. */
typedef struct OstDoubleMatrix {
    OstContext *ctx;
    int size;                  /* of a block, which is kept row by row: 3 or 6 */
    int borrowed;              /* the arrays and the halo are a block matrix' own */
    const OstScaling *scaling; /* of that, or NULL; the caller's */
    OstLocal rows, columns;
    OstLocal *row_start, *column; /* columns ascend within a row */
    double *value;
    OstHalo *halo;
} OstDoubleMatrix;

/* Local. A view of S A S^T, or of A where `scaling` is NULL. */
OstStatus ost_double_matrix_borrow(const OstBlockMatrix *matrix, const OstScaling *scaling, OstDoubleMatrix **source);
void ost_double_matrix_destroy(OstDoubleMatrix **source);

/* Local. Block k, one of row i: where it is kept, or scaled in `room`. `size` is the matrix', as a constant
 * where it is to be quick. */
OST_UNROLLED const double *ost_double_matrix_block(const OstDoubleMatrix *matrix, int size, OstLocal i, OstLocal k,
                                                   double room[9])
{
    const double *block = matrix->value + (size_t)(size * size) * (size_t)k;
    if (size != 3 || !matrix->scaling)
        return block;
    ost_scaling_block(matrix->scaling, i, matrix->column[k], block, room);
    return room;
}

/* Local. The block on the diagonal of a row, of a matrix that is not scaled. */
double *ost_double_matrix_diagonal(const OstDoubleMatrix *matrix, OstLocal row);

/* Local. Puts 1 on the diagonal where it is not positive, so that an unknown that the prolongator does not reach (a
 * mode its aggregate cannot show) does no harm. */
void ost_double_matrix_mend_diagonal(OstDoubleMatrix *matrix);

#endif

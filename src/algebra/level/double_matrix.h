/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_DOUBLE_MATRIX_H
#define ORTHOSTAT_ALGEBRA_LEVEL_DOUBLE_MATRIX_H

#include "algebra/level/simd.h"
#include "algebra/matrix/scaling.h"

/* A level's matrix in double precision, from which the next level is made. Rows are complete; columns are local
 * numbers, owned ones first, then ghosts. On the finest level it is a view of the stiffness, whose blocks are scaled on
 * access: a copy would take a fifth of the solver's memory. */
typedef struct OstDoubleMatrix {
    OstContext *ctx;
    int size;                  /* of a block (row-major): 3 or 6 */
    const OstBlockMatrix *of;  /* whose arrays and halo these are; NULL: its own */
    const OstScaling *scaling; /* of that block matrix, or NULL; the caller's */
    OstLocal rows, columns;
    OstLocal *row_start, *column; /* columns ascend within a row */
    double *value;
    OstHalo *halo;
} OstDoubleMatrix;

/* Local. A view of S A S^T, or of A where `scaling` is NULL. */
OstStatus ost_double_matrix_borrow(const OstBlockMatrix *matrix, const OstScaling *scaling, OstDoubleMatrix **source);
void ost_double_matrix_destroy(OstDoubleMatrix **source);

/* Collective. The global number of each column's first unknown, `first` being that of this rank's first row. The caller
 * frees it. */
OstStatus ost_double_matrix_numbers(const OstDoubleMatrix *matrix, OstGlobal first, OstGlobal **number);

/* Local. Block k, in row i: a pointer to it, or its scaled copy in `room`. `size` is the matrix's, passed as a constant
 * so that the compiler unrolls. */
OST_UNROLLED const double *ost_double_matrix_block(const OstDoubleMatrix *matrix, int size, OstLocal i, OstLocal k,
                                                   double room[9])
{
    double turned[9];
    if (size != 3 || !matrix->of)
        return matrix->value + (size_t)(size * size) * (size_t)k;
    if (!matrix->scaling)
        return ost_block_matrix_block(matrix->of, i, k, room);
    const double *block = ost_block_matrix_block(matrix->of, i, k, turned);
    ost_scaling_block(matrix->scaling, i, matrix->column[k], block, room);
    return room;
}

/* Local. The block of a row and a column that it has; not for a scaled view. */
double *ost_double_matrix_find(const OstDoubleMatrix *matrix, OstLocal row, OstLocal column);

/* Local. The diagonal block of a row; not for a scaled view. */
double *ost_double_matrix_diagonal(const OstDoubleMatrix *matrix, OstLocal row);

/* Local. Sets diagonal entries that are not positive to 1. They belong to unknowns that the prolongator does not reach:
 * a mode that is linearly dependent on its aggregate. */
void ost_double_matrix_mend_diagonal(OstDoubleMatrix *matrix);

#endif

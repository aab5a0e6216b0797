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
    double *value;                /* of a coarse matrix: its blocks in the order of the columns; or NULL: */
    double **chunk;               /* one triangle of them, OST_CHUNK in each of `chunks` */
    OstLocal chunks;
    OstLocal *place; /* row_start[rows]: which of them, or ~ the one whose transpose it is */
    OstHalo *halo;
} OstDoubleMatrix;

/* A coarse matrix is summed up without knowing how many blocks it will have: in chunks nothing is copied. */
enum { OST_CHUNK = 256, OST_BLOCK = OST_MODES * OST_MODES };

/* Local. Block b of chunks. */
static inline double *ost_chunk_block(double **chunk, OstLocal b)
{
    return chunk[b / OST_CHUNK] + (size_t)OST_BLOCK * (size_t)(b % OST_CHUNK);
}

/* Local. A view of S A S^T, or of A where `scaling` is NULL. */
OstStatus ost_double_matrix_borrow(const OstBlockMatrix *matrix, const OstScaling *scaling, OstDoubleMatrix **source);
void ost_double_matrix_destroy(OstDoubleMatrix **source);

/* Collective. The global number of each column's first unknown, `first` being that of this rank's first row. The caller
 * frees it. */
OstStatus ost_double_matrix_numbers(const OstDoubleMatrix *matrix, OstGlobal first, OstGlobal **number);

/* Local. Block k, in row i: a pointer to it, or its scaled copy in `room`. `size` is the matrix's, passed as a constant
 * so that the compiler unrolls. */
OST_UNROLLED const double *ost_double_matrix_block(const OstDoubleMatrix *matrix, int size, OstLocal i, OstLocal k,
                                                   double room[OST_BLOCK])
{
    double turned[9];
    if (matrix->chunk && matrix->place[k] >= 0)
        return ost_chunk_block(matrix->chunk, matrix->place[k]);
    if (matrix->chunk) {
        const double *block = ost_chunk_block(matrix->chunk, ~matrix->place[k]);
        for (int r = 0; r < OST_MODES; r++)
            for (int c = 0; c < OST_MODES; c++)
                room[OST_MODES * r + c] = block[OST_MODES * c + r];
        return room;
    }
    if (size != 3 || !matrix->of)
        return matrix->value + (size_t)(size * size) * (size_t)k;
    if (!matrix->scaling)
        return ost_block_matrix_block(matrix->of, i, k, room);
    const double *block = ost_block_matrix_block(matrix->of, i, k, turned);
    ost_scaling_block(matrix->scaling, i, matrix->column[k], block, room);
    return room;
}

/* Local. Puts the blocks of a coarse matrix in the order of its columns, both triangles. */
OstStatus ost_double_matrix_unfold(OstDoubleMatrix *matrix);

/* Local. The block of a row and a column that it has, or its transpose; not for a scaled view. */
double *ost_double_matrix_find(const OstDoubleMatrix *matrix, OstLocal row, OstLocal column);

/* Local. The diagonal block of a row; not for a scaled view. */
double *ost_double_matrix_diagonal(const OstDoubleMatrix *matrix, OstLocal row);

/* Local. Sets diagonal entries that are not positive to 1. They belong to unknowns that the prolongator does not reach:
 * a mode that is linearly dependent on its aggregate. */
void ost_double_matrix_mend_diagonal(OstDoubleMatrix *matrix);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_LEVEL_MATRIX_H
#define ORTHOSTAT_ALGEBRA_LEVEL_LEVEL_MATRIX_H

#include "algebra/level/double_matrix.h"
#include "algebra/trilinos/exchange.h"

/* A level's matrix as the multigrid cycle uses it. Between owned nodes only the blocks on and right of the diagonal are
 * stored, as the matrix is symmetric, and in single precision: a quarter of the memory traffic, and enough for a
 * preconditioner. Vectors are in double precision. */
typedef struct OstLevelMatrix {
    OstContext *ctx;
    int size; /* of a block: 3 or 6 */
    OstLocal rows, columns;
    OstLocal *row_start;               /* rows + 1 */
    OstLocal *own_end;                 /* rows: where a row's owned columns end and the ghosts begin */
    OstLocal *column;                  /* row_start[rows], ascending within a row, > row */
    float *diagonal;                   /* rows × size × size, row by row, and padding */
    float *value;                      /* row_start[rows] × size × size, row by row, and padding */
    float *diagonal_rest, *value_rest; /* what rounding took from both, or NULL */
    OstExchange *exchange;             /* of the ghosts of x */
    OstGlobal nonzeros;                /* of this rank's rows, both triangles */
} OstLevelMatrix;

/* Collective. The source is not kept. */
OstStatus ost_level_matrix_create(const OstDoubleMatrix *source, OstLevelMatrix **matrix);

/* Local. Keeps what rounding took from the source, in single precision again: products are then right to 1e-14. A body
 * with a contrast of 1e9 has motions whose energy is 1e-9 of their parts', which single precision alone does not hold.
 */
OstStatus ost_level_matrix_keep_rest(const OstDoubleMatrix *source, OstLevelMatrix *matrix);
void ost_level_matrix_destroy(OstLevelMatrix **matrix);

/* Local. Length of this rank's owned part of a vector. */
static inline size_t ost_level_unknowns(const OstLevelMatrix *matrix)
{
    return (size_t)matrix->size * (size_t)matrix->rows;
}

/* Local. A level vector: zeros for `columns` nodes, and the padding that the products need. */
OstStatus ost_level_vector_create(OstContext *ctx, int size, size_t columns, double **vector);

/* Collective over neighbours. y += scale A x; the ghosts of x are filled here. Both are level vectors: x over the
 * columns, y over the rows. */
void ost_level_matrix_add(const OstLevelMatrix *matrix, double scale, double *x, double *y);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_BLOCK_MATRIX_H
#define ORTHOSTAT_ALGEBRA_MATRIX_BLOCK_MATRIX_H

#include "core/parallel/halo.h"

/* A sparse matrix of 3×3 blocks, rows distributed: this rank's complete rows, columns in local numbers (owned rows
 * first, then the halo's ghosts), ascending within a row. Blocks are row-major. Folded (fold.h), a symmetric matrix
 * keeps the blocks on and right of the diagonal alone, which is half the memory; the list of columns stays whole. */
typedef struct OstBlockMatrix {
    OstContext *ctx;
    OstLocal rows;       /* block rows this rank owns */
    OstLocal columns;    /* rows + ghosts */
    OstGlobal first_row; /* global number of row 0 */
    OstGlobal global_rows;
    OstGlobal *label;    /* columns: each node's label, the same on any number of ranks */
    OstLocal *row_start; /* rows + 1 */
    OstLocal *column;    /* row_start[rows] */
    OstLocal *diagonal;  /* rows: where each diagonal block is */
    double *value;       /* row_start[rows] × 9; folded: without those left of the diagonal */
    OstLocal *upper;     /* folded: rows, where each diagonal block is among the values; else NULL */
    OstLocal *mirror;    /* folded: of each block left of the diagonal, where its transpose is; else NULL */
    OstHalo *halo;       /* over rows; owned by the matrix */
} OstBlockMatrix;

void ost_block_matrix_destroy(OstBlockMatrix **matrix);

/* Local. Where a column stands among the ascending ones of a row, which has it. */
static inline OstLocal ost_row_find(const OstLocal *row_start, const OstLocal *column, OstLocal row, OstLocal wanted)
{
    OstLocal low = row_start[row], high = row_start[row + 1] - 1;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (column[middle] < wanted)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Local. The diagonal block of a row. */
static inline const double *ost_block_matrix_diagonal(const OstBlockMatrix *matrix, OstLocal row)
{
    return matrix->value + 9 * (size_t)(matrix->upper ? matrix->upper[row] : matrix->diagonal[row]);
}

/* Local. Block k, in a row: a pointer to it, or a copy in `room` where its transpose is kept. */
static inline const double *ost_block_matrix_block(const OstBlockMatrix *matrix, OstLocal row, OstLocal k,
                                                   double room[9])
{
    if (!matrix->upper)
        return matrix->value + 9 * (size_t)k;
    const OstLocal upper = matrix->upper[row], right = k - matrix->diagonal[row];
    if (right >= 0)
        return matrix->value + 9 * (size_t)(upper + right);
    const double *block = matrix->value + 9 * (size_t)matrix->mirror[k - upper];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            room[3 * r + c] = block[3 * c + r];
    return room;
}

/* Collective over neighbours. y = A x; x has room for 3 × columns numbers, its ghosts are overwritten; y has 3 × rows.
 * Tasks (core/together) that ask for it of one matrix are served together. */
OstStatus ost_block_matrix_apply(const OstBlockMatrix *matrix, double *x, double *y);

/* Local. The same; the ghosts of x are already set. */
void ost_block_matrix_multiply(const OstBlockMatrix *matrix, const double *x, double *y);

/* Collective over neighbours. residual = f - A u by compensated sums, as if computed in twice the precision and rounded
 * once (Ogita, Rump, Oishi, Accurate sum and dot product, SIAM J. Sci. Comput. 26, 2005, Dot2). Costs about ten
 * products A u. u has room for 3 × columns numbers; its ghosts are filled here. */
OstStatus ost_compensated_residual(const OstBlockMatrix *matrix, const double *f, double *u, double *residual);

/* Collective over neighbours. The same, in plain double precision unless `compensated`. */
OstStatus ost_residual(const OstBlockMatrix *matrix, const double *f, double *u, int compensated, double *residual);

#endif

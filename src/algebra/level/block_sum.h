/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_BLOCK_SUM_H
#define ORTHOSTAT_ALGEBRA_LEVEL_BLOCK_SUM_H

#include "algebra/level/double_matrix.h"
#include "algebra/level/simd.h"
#include "core/index_map.h"

/* A coarse matrix in the making: 6 × 6 blocks that are found by row and column and added to. Rows and columns are this
 * rank's coarse nodes, then those of other ranks in the order in which they were met. The sum over the ranks is
 * symmetric: of what couples this rank's own nodes only what is on the diagonal or right of it is summed. */
typedef struct OstBlockSum {
    OstContext *ctx;
    OstGlobal first; /* global number of this rank's first node */
    OstLocal owned;  /* its nodes */
    OstIndex *ghost; /* other ranks' nodes, by global number */
    OstIndex *entry; /* the blocks, by row and column */
    double *value;   /* room × OST_MODES × OST_MODES: the blocks, row by row */
    OstLocal room;
} OstBlockSum;

/* Local. */
OstStatus ost_block_sum_create(OstContext *ctx, OstGlobal first, OstLocal owned, OstBlockSum **sum);
void ost_block_sum_destroy(OstBlockSum **sum);

/* Local. The local number of a node. */
OstStatus ost_block_sum_number(OstBlockSum *sum, OstGlobal number, OstLocal *node);

/* Local. Whether this block is left to its mirror image. */
static inline int ost_block_sum_is_mirrored(const OstBlockSum *sum, OstLocal row, OstLocal column)
{
    return column < row && row < sum->owned;
}

/* Local. A block, row by row, zeros if it is new; good until the next block is asked for. */
OstStatus ost_block_sum_find(OstBlockSum *sum, OstLocal row, OstLocal column, double **block);

/* Collective. Sends what was summed in other ranks' rows to their owners, which add it. The halo is over the first
 * columns here: this rank's nodes and the ghosts that were met first. */
OstStatus ost_block_sum_return(OstBlockSum *sum, OstHalo *halo);

/* Collective. The matrix: this rank's rows, both halves, columns ascending. */
OstStatus ost_block_sum_finish(const OstBlockSum *sum, OstDoubleMatrix **matrix);

#endif

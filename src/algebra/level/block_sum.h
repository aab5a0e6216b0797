/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_BLOCK_SUM_H
#define ORTHOSTAT_ALGEBRA_LEVEL_BLOCK_SUM_H

#include "algebra/level/double_matrix.h"
#include "algebra/level/simd.h"
#include "core/index_map.h"

/* A coarse matrix under construction: 6 × 6 blocks, found by row and column, to which contributions are added. Rows and
 * columns are this rank's coarse nodes, then those of other ranks in the order in which they appear. The matrix is
 * symmetric: of the blocks between this rank's own nodes only those on and right of the diagonal are summed. */
typedef struct OstBlockSum {
    OstContext *ctx;
    OstGlobal first;       /* global number of this rank's first node */
    OstLocal owned;        /* number of its nodes */
    OstIndex *ghost;       /* other ranks' nodes, by global number */
    OstIndex *entry;       /* the blocks, by row and column */
    double **chunk;        /* the blocks, row by row, OST_CHUNK in each */
    OstLocal chunks, room; /* room: of the list of chunks */
} OstBlockSum;

OstStatus ost_block_sum_create(OstContext *ctx, OstGlobal first, OstLocal owned, OstBlockSum **sum);
void ost_block_sum_destroy(OstBlockSum **sum);

/* Local. The local number of a node, a new one if it has not appeared before. */
OstStatus ost_block_sum_number(OstBlockSum *sum, OstGlobal number, OstLocal *node);

/* Local. Is this block left out, as its transpose is summed? */
static inline int ost_block_sum_is_mirrored(const OstBlockSum *sum, OstLocal row, OstLocal column)
{
    return column < row && row < sum->owned;
}

/* Local. A block, row by row; zeros if it is new. The pointer is valid until the next call. */
OstStatus ost_block_sum_find(OstBlockSum *sum, OstLocal row, OstLocal column, double **block);

/* Collective. Sends the blocks of other ranks' rows to their owners, which add them. The halo is over this rank's nodes
 * and the ghosts that appeared first. */
OstStatus ost_block_sum_return(OstBlockSum *sum, OstHalo *halo);

/* Collective. The matrix: this rank's rows, columns ascending. It takes over the blocks. */
OstStatus ost_block_sum_finish(OstBlockSum *sum, OstDoubleMatrix **matrix);

#endif

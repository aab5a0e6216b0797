/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_SMOOTHER_BLOCKS_H
#define ORTHOSTAT_ALGEBRA_LEVEL_SMOOTHER_BLOCKS_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/level_matrix.h"

/* The most nodes and rows of a block. */
enum { OST_LARGEST_BLOCK = 24, OST_LARGEST_SIDE = 6 * OST_LARGEST_BLOCK };

/* Block Jacobi: the inverses B^-1 of a matrix's diagonal blocks, over groups of nodes that do not overlap. */
typedef struct OstSmootherBlocks {
    OstContext *ctx;
    int size; /* unknowns per node */
    OstLocal count;
    OstLocal *node_start; /* count + 1 */
    OstLocal *node;       /* nodes, block by block */
    size_t *value_start;  /* count + 1 */
    float *value;         /* dense symmetric inverses, and padding */
} OstSmootherBlocks;

/* Local. Blocks of about `target` nodes, round in the graph's metric. Blocks are softened a little. If one is not
 * positive definite, its nodes' blocks are inverted instead, and of those that are not either, the diagonal. */
OstStatus ost_smoother_blocks_create(const OstLevelMatrix *matrix, const OstMetricGraph *graph, double target,
                                     OstSmootherBlocks **blocks);

/* Local. The same with given groups of nodes, those of more than 24 split. */
OstStatus ost_smoother_blocks_of(const OstLevelMatrix *matrix, const OstAggregates *groups, OstSmootherBlocks **blocks);
void ost_smoother_blocks_destroy(OstSmootherBlocks **blocks);

/* One step of an iteration: direction = keep × direction + add × B^-1 r, then x += direction. `from_zero`: both are 0
 * before it, and need not be set to 0. */
typedef struct OstBlockStep {
    double keep, add;
    double *direction, *x;
    int from_zero;
} OstBlockStep;

void ost_smoother_blocks_step(const OstSmootherBlocks *blocks, const OstBlockStep *step, const double *r);

#endif

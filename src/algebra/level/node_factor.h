/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_NODE_FACTOR_H
#define ORTHOSTAT_ALGEBRA_LEVEL_NODE_FACTOR_H

#include "orthostat/context.h"

/* Cholesky's factor L of a small sparse matrix of 3×3 blocks, in single precision. */
typedef struct OstNodeFactor {
    OstLocal count;  /* nodes */
    OstLocal *start; /* count + 1 */
    OstLocal *row;   /* start[count]: of a column's blocks, those below the diagonal, ascending */
    float *diagonal; /* count × 9: inverses of the diagonal blocks, row-major, and zeros above */
    float *value;    /* start[count] × 9 */
} OstNodeFactor;

/* Local. The pattern of the factor, by nested dissection. `start` and `neighbour` list each node's neighbours without
 * itself; node order[n] of theirs is node n of the factor. */
OstStatus ost_node_factor_plan(OstContext *ctx, OstLocal count, const OstLocal *start, const OstLocal *neighbour,
                               OstLocal *order, OstNodeFactor *factor);
void ost_node_factor_clear(OstNodeFactor *factor);

/* Local. Factors a matrix in double precision: its blocks on the diagonal, and those below it in the factor's pattern.
 * Both are overwritten. *pivot is 0, or the node, from 1, whose block is not positive definite. */
OstStatus ost_node_factor_fill(OstContext *ctx, double *diagonal, double *value, OstNodeFactor *factor, int *pivot);

/* Local. The block of a row and a column that the pattern has, among the values. */
OstLocal ost_node_factor_find(const OstNodeFactor *factor, OstLocal row, OstLocal column);

/* Local. x = (L Lᵀ)⁻¹ x */
void ost_node_factor_solve(const OstNodeFactor *factor, float *x);

#endif

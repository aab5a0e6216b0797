/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_PATCHES_H
#define ORTHOSTAT_ALGEBRA_LEVEL_PATCHES_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/double_matrix.h"

/* Overlapping patches of the nodes of a matrix of 3×3 blocks, some hundreds of nodes each and round in the graph's
 * metric, whose own matrices are factored: multiplicative Schwarz (Smith, Bjørstad, Gropp, Domain Decomposition, 1996).
 * Where nearly all of a node's motions are hardly allowed, those that are take many nodes, and no coarse node has them.
 */
typedef struct OstPatches OstPatches;

/* Collective. A patch grows by so many layers of nodes. A view of the matrix is kept: what it is a view of must outlive
 * the patches. Raises OST_OUT_OF_MEMORY if the factors do not fit into what is free. `safe`: single precision has been
 * found to lose some of them. */
OstStatus ost_patches_create(const OstDoubleMatrix *matrix, const OstMetricGraph *graph, int layers, int safe,
                             OstPatches **patches);
void ost_patches_destroy(OstPatches **patches);

/* Local. Improves z towards A z = r between this rank's rows, patch by patch, in their order or in the reverse one. */
void ost_patches_sweep(const OstPatches *patches, int reverse, const double *r, double *z);

/* Local. OstLocalSolve: z = M^-1 r by a sweep in either order from 0; symmetric. */
void ost_patches_solve(const void *patches, const double *r, double *z);

#endif

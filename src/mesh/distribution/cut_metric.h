/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_CUT_METRIC_H
#define ORTHOSTAT_MESH_DISTRIBUTION_CUT_METRIC_H

#include "mesh/distribution/graph.h"

/* What a cut sees of the material at the slab's nodes and ghosts: position (3 numbers) and the mean metric of the tets
 * around (6). NULL stands for a body that is as stiff in one direction as in another. */
typedef struct NodeMetric {
    double position[3];
    double metric[6];
} NodeMetric;

/* Collective. `nodes` is of node_count + ghost_count entries, the caller's to free. */
OstStatus ost_cut_metric_create(const OstMeshChunk *chunk, const Slab *slab, const OstTetMetric *tets,
                                NodeMetric **nodes);

/* Local. Weighs the edges of a slab's graph by what a border costs that runs through them: multigrid works within a
 * rank, so that what is stiff should stay together. An edge weighs the square of its length over that in the metric,
 * which is the ratio of its coupling to one along the softest direction: 1 there, √(E_max / E_min) along the stiffest,
 * and at most HEAVIEST_EDGE, beyond which METIS would have only these to balance. */
enum { HEAVIEST_EDGE = 1000 };
OstStatus ost_cut_metric_weigh(const Slab *slab, const NodeMetric *nodes, Graph *graph);

#endif

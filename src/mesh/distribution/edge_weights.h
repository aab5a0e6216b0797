/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_EDGE_WEIGHTS_H
#define ORTHOSTAT_MESH_DISTRIBUTION_EDGE_WEIGHTS_H

#include "mesh/distribution/graph.h"

/* Position of a node, and mean material metric of the tets around it. */
typedef struct NodeMetric {
    double position[3];
    double metric[6];
} NodeMetric;

/* Collective. One entry for each of the slab's nodes and ghosts; the caller frees *nodes. */
OstStatus ost_node_metrics_create(const OstMeshChunk *chunk, const Slab *slab, const OstTetMetric *tets,
                                  NodeMetric **nodes);

/* Local. Weights the edges of the slab's graph for METIS, so that the partition does not cut stiff couplings: multigrid
 * aggregates within a rank. The weight is (length / length in the material metric)², the ratio of the edge's coupling
 * to one along the softest direction: 1 there, √(E_max / E_min) along the stiffest. It is limited to HEAVIEST_EDGE,
 * because METIS disregards all other edges beside very heavy ones. */
enum { HEAVIEST_EDGE = 1000 };
OstStatus ost_graph_weigh_edges(const Slab *slab, const NodeMetric *nodes, Graph *graph);

#endif

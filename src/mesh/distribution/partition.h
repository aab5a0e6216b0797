/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_PARTITION_H
#define ORTHOSTAT_MESH_DISTRIBUTION_PARTITION_H

#include "mesh/distribution/graph.h"
#include "mesh/distribution/slab.h"

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

/* Collective. The part of each of the slab's nodes and ghosts (part: node_count + ghost_count numbers): one part per
 * rank, none empty. If one rank has all nodes, METIS partitions their graph there. Otherwise METIS divides each rank's
 * nodes into small clusters, and rank 0 partitions the graph of clusters, so that no rank needs the whole mesh; each
 * rank's nodes should then lie close together. The slab must have all tets that touch its nodes. `metric` (of the nodes
 * and ghosts; NULL: none) weights the edges, so that stiff couplings are not cut. */
OstStatus ost_partition(const Slab *slab, const NodeMetric *metric, int *part);

/* Collective. Moves the chunk's nodes and tets to the ranks of their parts (`part`: of the slab's nodes and ghosts) and
 * fills `mesh`. Within a part, nodes and tets keep their order. Frees the chunk's arrays as it goes. */
OstStatus ost_mesh_redistribute(OstMeshChunk *chunk, const Slab *slab, const int *part, OstMesh *mesh);

#endif

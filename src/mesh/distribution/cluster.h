/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_CLUSTER_H
#define ORTHOSTAT_MESH_DISTRIBUTION_CLUSTER_H

#include "mesh/distribution/graph.h"

/* The slab's nodes in clusters, which have global numbers. */
typedef struct Clusters {
    OstLocal count;  /* of this rank */
    OstGlobal first; /* number of this rank's first cluster */
    OstGlobal total; /* of all ranks */
    idx_t *of_node;  /* global number of the cluster of each node and ghost of the slab */
} Clusters;

/* Collective. Start from {0}; clear also after a failure. */
OstStatus ost_clusters_create(const Slab *slab, const Graph *nodes, Clusters *clusters);
void ost_clusters_clear(Clusters *clusters);

/* Local. This rank's rows of the graph of clusters: neighbours are global numbers; the weight of an edge is the sum
 * over the edges between its clusters' nodes, the weight of a row the number of nodes. */
OstStatus ost_cluster_graph(const Slab *slab, const Graph *nodes, const Clusters *clusters, Graph *graph);

/* Local. Partitions a graph: METIS_PartGraphKway with a fixed seed, or directly for graphs that METIS refuses. */
OstStatus ost_metis_partition(OstContext *ctx, const Graph *graph, idx_t parts, idx_t *part);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_CLUSTER_H
#define ORTHOSTAT_MESH_DISTRIBUTION_CLUSTER_H

#include "mesh/distribution/graph.h"

/* A slab's nodes in clusters, numbered over all ranks. */
typedef struct Clusters {
    OstLocal count;  /* of this rank */
    OstGlobal first; /* number of this rank's first */
    OstGlobal total; /* over all ranks */
    idx_t *of_node;  /* of the slab's nodes and ghosts: numbers over all ranks */
} Clusters;

/* Collective. Start from {0}; clear also after a failure. */
OstStatus ost_clusters_create(const Slab *slab, const Graph *nodes, Clusters *clusters);
void ost_clusters_clear(Clusters *clusters);

/* Local. The rows of this rank's clusters: neighbours are numbers over all ranks; an edge weighs what the edges
 * between its clusters' nodes do, a row the nodes in it. */
OstStatus ost_cluster_graph(const Slab *slab, const Graph *nodes, const Clusters *clusters, Graph *graph);

/* Local. METIS_PartGraphKway with fixed seed, also for the cases that it does not take. */
OstStatus ost_metis_cut(OstContext *ctx, const Graph *graph, idx_t parts, idx_t *part);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_PARTITION_H
#define ORTHOSTAT_MESH_DISTRIBUTION_PARTITION_H

#include "mesh/distribution/edge_weights.h"

/* Collective. The part of each of the slab's nodes and ghosts (part: node_count + ghost_count numbers): one part per
 * rank, none empty. If one rank has all nodes, METIS partitions their graph there. Otherwise METIS divides each rank's
 * nodes into small clusters, and rank 0 partitions the graph of clusters, so that no rank needs the whole mesh.
 * `metric` (of the nodes and ghosts; NULL: none) weights the edges, so that stiff couplings are not cut. */
OstStatus ost_partition(const Slab *slab, const NodeMetric *metric, int *part);

#endif

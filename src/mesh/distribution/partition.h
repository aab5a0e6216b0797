/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_PARTITION_H
#define ORTHOSTAT_MESH_DISTRIBUTION_PARTITION_H

#include "mesh/distribution/cut_metric.h"

/* Collective. Parts of the slab's nodes and ghosts (node_count + ghost_count numbers of the caller), one part per rank,
 * none of them empty. Where one rank holds all nodes, METIS cuts their graph there. Where they are spread, METIS first
 * cuts each rank's nodes into small clusters, and then the graph of all clusters on rank 0: no rank sees the whole
 * mesh. `metric` (NULL: none) is of the slab's nodes and ghosts, and keeps what is stiff together. */
OstStatus ost_partition(const Slab *slab, const NodeMetric *metric, int *part);

#endif

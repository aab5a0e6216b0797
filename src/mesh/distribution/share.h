/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_SHARE_H
#define ORTHOSTAT_MESH_DISTRIBUTION_SHARE_H

#include "mesh/mesh_data.h"

/* Collective. Gives every rank without a chunk (NULL) an empty one that agrees with rank 0's: the same global counts,
 * regions and boundaries, but no nodes, tets or items. Rank 0 must have one. Raises OST_INVALID_INPUT if a rank's own
 * chunk names other regions or boundaries than rank 0's. On failure all chunks are destroyed. */
OstStatus ost_chunk_share(OstContext *ctx, OstMeshChunk **chunk);

#endif

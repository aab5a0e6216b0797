/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_MERGE_H
#define ORTHOSTAT_MESH_DISTRIBUTION_MERGE_H

#include "mesh/mesh_data.h"

/* Collective. Merges vertices of the chunk that are no farther apart than `tolerance` (above 0): the one with the
 * lowest number stays, with its label and position; *merged is the number of vertices removed. Raises OST_INVALID_INPUT
 * if the tolerance reaches the shortest edge of a tet, or if vertices form a chain whose neighbours are within the
 * tolerance but whose ends are not. */
OstStatus ost_chunk_merge(OstMeshChunk *chunk, double tolerance, OstGlobal *merged);

#endif

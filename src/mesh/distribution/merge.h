/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_MERGE_H
#define ORTHOSTAT_MESH_DISTRIBUTION_MERGE_H

#include "mesh/mesh_data.h"

/* Collective. Joins vertices of the chunk that are no farther apart than `tolerance` (above 0): of such vertices the
 * one with the lowest number stays, with its label and place; `merged` is how many went. Raises OST_INVALID_INPUT if
 * the tolerance reaches the shortest edge of a tet, or if vertices form a chain in which neighbours are within it but
 * ends are not. */
OstStatus ost_chunk_merge(OstMeshChunk *chunk, double tolerance, OstGlobal *merged);

#endif

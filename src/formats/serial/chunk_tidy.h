/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_CHUNK_TIDY_H
#define ORTHOSTAT_FORMATS_SERIAL_CHUNK_TIDY_H

#include "mesh/mesh_data.h"

/* Local. Sorts a whole mesh's tets by their labels; if two share one, numbers all from 1 instead, with a warning. */
OstStatus ost_tets_sort(OstMeshChunk *chunk, const char *path);

/* Local. Reorders the vertices of all tets of a whole mesh, with a warning, if some are inverted and the others flat.
 */
void ost_tets_turn(OstMeshChunk *chunk, const char *path);

/* Local. Reorders the vertices of each tet that is inverted; returns how many were. Raises OST_INVALID_INPUT if nodes
 * of this rank's tets are on other ranks (.vtkhdf on several). */
OstStatus ost_tets_orient(OstMeshChunk *chunk, const char *path, OstLocal *turned);

/* Local. Keeps one of the tets of a whole mesh that have the same vertices and lie in several regions: it goes to the
 * region of these with the fewest tets, and regions that lose all theirs are removed; warns. Raises OST_INVALID_INPUT
 * if two tets of one region, with different labels, have the same vertices. */
OstStatus ost_tets_join_same(OstMeshChunk *chunk, const char *path);

/* Local. Leaves out the nodes of a whole mesh that no tet uses, and the items of boundaries on them, with a warning. */
OstStatus ost_nodes_leave_out(OstMeshChunk *chunk, const char *path);

#endif

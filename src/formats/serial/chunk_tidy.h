/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_CHUNK_TIDY_H
#define ORTHOSTAT_FORMATS_SERIAL_CHUNK_TIDY_H

#include "mesh/mesh_data.h"

/* Local. Puts a whole mesh's tets in the order of their labels; raises OST_INVALID_INPUT if two share one. */
OstStatus ost_tets_sort(OstMeshChunk *chunk, const char *path);

/* Local. Turns the tets of a whole mesh if none is positively oriented and some is not flat, and says so. */
void ost_tets_turn(OstMeshChunk *chunk, const char *path);

/* Local. Raises OST_INVALID_INPUT if two tets of a whole mesh have the same four vertices. */
OstStatus ost_tets_refuse_same(const OstMeshChunk *chunk, const char *path);

/* Local. Leaves out the nodes of a whole mesh that no tet uses, with the items of boundaries on them, and says so. */
OstStatus ost_nodes_leave_out(OstMeshChunk *chunk, const char *path);

#endif

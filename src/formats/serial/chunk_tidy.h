/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_CHUNK_TIDY_H
#define ORTHOSTAT_FORMATS_SERIAL_CHUNK_TIDY_H

#include "mesh/mesh_data.h"

/* Local. Sorts a whole mesh's tets by their labels; raises OST_INVALID_INPUT if two share one. */
OstStatus ost_tets_sort(OstMeshChunk *chunk, const char *path);

/* Local. Reorders the vertices of all tets of a whole mesh, with a warning, if some are inverted and the others flat.
 */
void ost_tets_turn(OstMeshChunk *chunk, const char *path);

/* Local. Raises OST_INVALID_INPUT if two tets of a whole mesh have the same four vertices. */
OstStatus ost_tets_refuse_same(const OstMeshChunk *chunk, const char *path);

/* Local. Leaves out the nodes of a whole mesh that no tet uses, and the items of boundaries on them, with a warning. */
OstStatus ost_nodes_leave_out(OstMeshChunk *chunk, const char *path);

#endif

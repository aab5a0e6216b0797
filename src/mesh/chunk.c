/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/memory.h"
#include "mesh/names.h"

void ost_chunk_destroy(OstMeshChunk **chunk)
{
    OstMeshChunk *old = *chunk;
    if (!old)
        return;
    OST_FREE(old->coordinates);
    OST_FREE(old->node_label);
    OST_FREE(old->tet_nodes);
    OST_FREE(old->tet_label);
    OST_FREE(old->tet_region);
    OST_FREE(old->tet_axes);
    ost_names_clear(&old->regions);
    ost_boundaries_destroy(old->boundary_count, &old->boundaries);
    OST_FREE(*chunk);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/used_nodes.h"

#include "core/error.h"
#include "core/memory.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static OstGlobal tet_entries(const OstMeshChunk *chunk)
{
    return (OstGlobal)chunk->tet_count * chunk->nodes_per_tet;
}

/* Where each node goes; -1: it is left out. Gives the number that stay. */
static OstLocal number_used(const OstMeshChunk *chunk, OstLocal *number)
{
    OstLocal used = 0;
    for (OstGlobal i = 0; i < tet_entries(chunk); i++)
        number[chunk->tet_nodes[i]] = 1;
    for (OstLocal n = 0; n < chunk->node_count; n++)
        number[n] = number[n] ? used++ : -1;
    return used;
}

static void move_nodes(OstMeshChunk *chunk, const OstLocal *number)
{
    for (OstLocal n = 0; n < chunk->node_count; n++) {
        if (number[n] < 0)
            continue;
        chunk->node_label[number[n]] = chunk->node_label[n];
        memmove(chunk->coordinates + 3 * (size_t)number[n], chunk->coordinates + 3 * (size_t)n,
                3 * sizeof *chunk->coordinates);
    }
    for (OstGlobal i = 0; i < tet_entries(chunk); i++)
        chunk->tet_nodes[i] = number[chunk->tet_nodes[i]];
}

/* Gives the number of items left out. */
static OstLocal move_items(OstBoundary *boundary, const OstLocal *number)
{
    const OstLocal before = boundary->count;
    const size_t width = (size_t)boundary->nodes_per_item;
    boundary->count = 0;
    for (OstLocal i = 0; i < before; i++) {
        const OstGlobal *from = boundary->nodes + (size_t)i * width;
        OstGlobal *to = boundary->nodes + (size_t)boundary->count * width;
        size_t used = 0;
        for (; used < width && number[from[used]] >= 0; used++)
            to[used] = number[from[used]];
        boundary->count += used == width;
    }
    return before - boundary->count;
}

static void say_left_out(const OstMeshChunk *chunk, const char *path, OstLocal nodes, OstGlobal items)
{
    char more[80] = "";
    if (items > 0)
        snprintf(more, sizeof more, ", and %" PRId64 " points, curves and faces of boundaries with them", items);
    ost_warn(chunk->ctx, "%s: %d %s used by no tet and left out%s", path, nodes,
             nodes == 1 ? "vertex is" : "vertices are", more);
}

OstStatus ost_nodes_leave_out(OstMeshChunk *chunk, const char *path)
{
    OstLocal *number = NULL;
    OST_TRY(OST_NEW(chunk->ctx, &number, chunk->node_count));
    const OstLocal used = number_used(chunk, number);
    const OstLocal unused = chunk->node_count - used;
    OstGlobal items = 0;
    if (unused > 0) {
        move_nodes(chunk, number);
        for (int b = 0; b < chunk->boundary_count; b++)
            items += move_items(&chunk->boundaries[b], number);
        chunk->node_count = used;
        say_left_out(chunk, path, unused, items);
    }
    chunk->global_nodes = used;
    OST_FREE(number);
    return OST_SUCCESS;
}

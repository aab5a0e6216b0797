/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/refinement/inherit.h"

#include "core/error.h"
#include "core/memory.h"

int ost_nodes_per_item(int nodes_per_tet, int dimension)
{
    static const int nodes[2][3] = {{1, 2, 3}, {1, 3, 6}};
    return nodes[nodes_per_tet == 10][dimension];
}

static OstStatus copy_names(OstContext *ctx, const OstNames *from, OstNames *to)
{
    OST_TRY(OST_NEW(ctx, &to->name, from->count));
    for (; to->count < from->count; to->count++)
        OST_TRY(ost_copy_string(ctx, from->name[to->count], &to->name[to->count]));
    return OST_SUCCESS;
}

OstStatus ost_mesh_inherit(const OstMesh *parent, int nodes_per_tet, OstMesh **mesh)
{
    OstContext *ctx = parent->ctx;
    OST_TRY(OST_NEW(ctx, mesh, 1));
    OstMesh *made = *mesh;
    made->ctx = ctx;
    made->nodes_per_tet = nodes_per_tet;
    OST_TRY(copy_names(ctx, &parent->regions, &made->regions));
    OST_TRY(OST_NEW(ctx, &made->boundaries, parent->boundary_count));
    for (; made->boundary_count < parent->boundary_count; made->boundary_count++) {
        const OstBoundary *from = &parent->boundaries[made->boundary_count];
        OstBoundary *to = &made->boundaries[made->boundary_count];
        to->dimension = from->dimension;
        to->nodes_per_item = ost_nodes_per_item(nodes_per_tet, from->dimension);
        OST_TRY(ost_copy_string(ctx, from->name, &to->name));
    }
    return OST_SUCCESS;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/route.h"
#include "mesh/distribution/redistribute.h"
#include "mesh/local_number.h"

/* From new global numbers to local ones. If a node is not here, no tet has all nodes of the item. */
static OstStatus number_locally(OstBoundary *boundary, const OstMesh *mesh)
{
    const size_t width = (size_t)boundary->nodes_per_item;
    for (size_t i = 0; i < (size_t)boundary->count * width; i++) {
        const OstLocal local = ost_mesh_local(mesh, boundary->nodes[i]);
        if (local < 0)
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "boundary '%s' has a %s that is no %s of any tet; remove it or mesh the body with it",
                             boundary->name, boundary->dimension == 1 ? "curve" : "face",
                             boundary->dimension == 1 ? "edge" : "face");
        boundary->nodes[i] = local;
    }
    return OST_SUCCESS;
}

OstStatus ost_boundary_redistribute(OstBoundary *boundary, const Slab *slab, const int *part, const OstGlobal *number,
                                    const OstMesh *mesh)
{
    OstContext *ctx = mesh->ctx;
    const size_t width = (size_t)boundary->nodes_per_item;
    const size_t entries = (size_t)boundary->count * width;
    int *to = NULL;
    OstRoute *route = NULL;
    OstGlobal *arrived = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &to, entries)));
    for (size_t i = 0; i < entries; i++) {
        const OstLocal local = ost_slab_local(slab, boundary->nodes[i]);
        to[i] = part[local];
        boundary->nodes[i] = number[local];
    }
    OST_TRY_DONE(ost_route_create(ctx, boundary->count, boundary->nodes_per_item, to, &route));
    OST_TRY_DONE(ost_route_carry(route, width * sizeof(OstGlobal), boundary->nodes, (void **)&arrived));
    OST_FREE(boundary->nodes);
    boundary->nodes = arrived;
    boundary->count = route->receives;
    OST_TRY_DONE(ost_agree(ctx, number_locally(boundary, mesh)));
done:
    OST_FREE(to);
    ost_route_destroy(&route);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/mark_ties.h"

#include "adapt/mark.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/small.h"

#include <math.h>
#include <string.h>

/* In one level: a side that begins far coarser catches up over several, as memory bounds a level's growth. */
enum { MOST_CUTS = 2 * OST_MOST_CUTS };

/* How fine a tet is, in cuts: three of them halve its longest edge. */
static double fineness(const OstMesh *mesh, OstLocal tet, int times)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    double longest = 0.0;
    for (int a = 0; a < 4; a++)
        for (int b = a + 1; b < 4; b++) {
            const double *x = mesh->coordinates + 3 * (size_t)nodes[a], *y = mesh->coordinates + 3 * (size_t)nodes[b];
            longest = fmax(longest, ost_norm3((double[3]){y[0] - x[0], y[1] - x[1], y[2] - x[2]}));
        }
    return times - 3.0 * log2(longest);
}

/* Collective. The finest tet at each of the links' slots, once all are cut. */
static OstStatus find_finest(const OstMesh *mesh, const OstLinks *links, const unsigned char *times, double *finest)
{
    double *at_node = NULL;
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &at_node, mesh->node_count)));
    for (OstLocal n = 0; n < mesh->node_count; n++)
        at_node[n] = -INFINITY;
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        const double of_tet = fineness(mesh, t, times[t]);
        for (int a = 0; a < mesh->nodes_per_tet; a++)
            at_node[nodes[a]] = fmax(at_node[nodes[a]], of_tet);
    }
    OstStatus status = ost_agree(mesh->ctx, ost_halo_max_at_owners(mesh->halo, 1, at_node));
    memcpy(finest, at_node, (size_t)mesh->owned_nodes * sizeof *finest);
    OST_THEN(ost_agree(mesh->ctx, ost_halo_import(links->halo, sizeof *finest, finest)));
    OST_FREE(at_node);
    return status;
}

/* The finest tet at the faces that a tet's nodes follow; -INFINITY: they follow none. */
static double finest_followed(const OstMesh *mesh, const OstLinks *links, const double *finest, OstLocal tet)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    double followed = -INFINITY;
    for (int a = 0; a < mesh->nodes_per_tet; a++) {
        const OstLink *link = ost_link_of(links, nodes[a]);
        for (int k = 0; link && link->between_meshes && k < link->count; k++)
            followed = fmax(followed, finest[link->slot[k]]);
    }
    return followed;
}

OstStatus ost_mark_ties(const OstMesh *mesh, const OstLinks *links, unsigned char *times)
{
    double *finest = NULL;
    if (!links)
        return OST_SUCCESS;
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &finest, links->slots)));
    const OstStatus status = find_finest(mesh, links, times, finest);
    for (OstLocal t = 0; t < mesh->owned_tets && status == OST_SUCCESS; t++) {
        const double more = finest_followed(mesh, links, finest, t) - fineness(mesh, t, times[t]);
        if (more > 0.5)
            times[t] = (unsigned char)fmin(times[t] + round(more), MOST_CUTS);
    }
    OST_FREE(finest);
    return status;
}

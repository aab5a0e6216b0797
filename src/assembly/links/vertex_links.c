/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/links.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"

#include <string.h>

/* The number in the linear mesh of each node in the halo's arrays; -1: the node follows others, or is no vertex. */
static OstStatus number_leaders(const OstLinks *quadratic, const OstMesh *linear, const OstLocal *node_of_vertex,
                                OstGlobal **number)
{
    OstStatus status = OST_NEW(quadratic->ctx, number, quadratic->slots);
    for (OstLocal n = 0; n < quadratic->mesh->owned_nodes && status == OST_SUCCESS; n++)
        (*number)[n] = -1;
    for (OstLocal v = 0; v < linear->owned_nodes && status == OST_SUCCESS; v++)
        if (quadratic->of_node[node_of_vertex[v]] < 0)
            (*number)[node_of_vertex[v]] = linear->node_number[v];
    OST_TRY(ost_agree(quadratic->ctx, status));
    return ost_agree(quadratic->ctx, ost_halo_import(quadratic->halo, sizeof **number, *number));
}

/* Adds the link of a vertex. Sets *fails if a node that it follows has no number. */
static OstStatus add_vertex(const OstLink *link, const OstGlobal *number, OstLocal vertex, OstLinks *links, int *fails)
{
    static const double nothing[3] = {0.0};
    OstLeader leader[OST_MOST_CORNERS];
    *fails |= link->corners == 0;
    for (int k = 0; k < link->corners; k++) {
        leader[k] = (OstLeader){.number = number[link->corner_slot[k]]};
        memcpy(leader[k].weight, link->corner_weight[k], sizeof leader[k].weight);
        *fails |= leader[k].number < 0;
    }
    return *fails ? OST_SUCCESS : ost_links_add(links, vertex, link->corners, leader, link->place, nothing);
}

OstStatus ost_links_on_vertices(const OstLinks *quadratic, const OstMesh *linear, const OstLocal *node_of_vertex,
                                OstLinks **links)
{
    OstContext *ctx = quadratic->ctx;
    OstGlobal *number = NULL;
    int fails = quadratic->face_count > 0;
    OstStatus status = ost_agree(ctx, ost_links_create(linear, links));
    OST_THEN(number_leaders(quadratic, linear, node_of_vertex, &number));
    for (OstLocal v = 0; v < linear->owned_nodes && status == OST_SUCCESS && !fails; v++) {
        const OstLink *link = ost_link_of(quadratic, node_of_vertex[v]);
        if (link)
            status = add_vertex(link, number, v, *links, &fails);
    }
    status = ost_agree(ctx, status);
    OST_THEN(ost_max_ints(ctx, 1, &fails));
    OST_FREE(number);
    if (status != OST_SUCCESS || fails)
        ost_links_destroy(links);
    return status;
}

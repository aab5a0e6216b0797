/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/refinement/mid_nodes.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"

#include <string.h>

void ost_mid_nodes_clear(MidNodes *mid)
{
    ost_edge_table_clear(&mid->edges);
    OST_FREE(mid->number, mid->label, mid->coordinates);
}

int ost_mid_nodes_owns(const MidNodes *mid, OstLocal node)
{
    return mid->number[node] >= mid->first_node && mid->number[node] < mid->first_node + mid->owned_nodes;
}

static OstStatus allocate(MidNodes *mid)
{
    const OstGlobal count = (OstGlobal)mid->mesh->node_count + mid->edges.count;
    if (count > INT32_MAX)
        return OST_RAISE(mid->mesh->ctx, OST_LIMIT_EXCEEDED,
                         "a rank would hold %lld nodes, more than the %d it can number; use more ranks",
                         (long long)count, INT32_MAX);
    mid->count = (OstLocal)count;
    OST_TRY(OST_NEW(mid->mesh->ctx, &mid->number, count));
    OST_TRY(OST_NEW(mid->mesh->ctx, &mid->label, count));
    return OST_NEW(mid->mesh->ctx, &mid->coordinates, 3 * (size_t)count);
}

/* Numbers each owned vertex, and after it the edges of which it is the low end. */
static OstStatus number_owned(MidNodes *mid)
{
    const OstMesh *mesh = mid->mesh;
    mid->owned_nodes = mesh->owned_nodes + mid->edges.start[mesh->owned_nodes];
    OST_TRY(ost_number_from(mesh->ctx, mid->owned_nodes, &mid->first_node, &mid->global_nodes));
    OstGlobal next = mid->first_node;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        mid->number[n] = next++;
        for (OstLocal e = mid->edges.start[n]; e < mid->edges.start[n + 1]; e++)
            mid->number[mesh->node_count + e] = next++;
    }
    return ost_agree(mesh->ctx, ost_halo_import(mesh->halo, sizeof *mid->number, mid->number));
}

/* An edge, by the old global numbers of its ends. */
typedef struct Ends {
    OstGlobal low, high;
} Ends;

/* Lists the edges that other ranks own, and these ranks. */
static void list_questions(const MidNodes *mid, Ends *ends, int *to)
{
    const OstMesh *mesh = mid->mesh;
    const OstHalo *halo = mesh->halo;
    const OstLocal owned = mid->edges.start[mesh->owned_nodes];
    int k = 0;
    for (OstLocal e = owned; e < mid->edges.count; e++) {
        const OstLocal low = mid->edges.low[e];
        while (low - mesh->owned_nodes >= halo->receive_start[k + 1])
            k++;
        to[e - owned] = halo->neighbour[k];
        ends[e - owned] = (Ends){mesh->node_number[low], mesh->node_number[mid->edges.high[e]]};
    }
}

static OstStatus look_up(const MidNodes *mid, OstLocal count, const Ends *ends, OstGlobal *answer)
{
    const OstMesh *mesh = mid->mesh;
    for (OstLocal i = 0; i < count; i++) {
        const OstLocal low = ost_mesh_local(mesh, ends[i].low);
        const OstLocal high = ost_mesh_local(mesh, ends[i].high);
        const OstLocal edge = low < 0 || high < 0 ? -1 : ost_edge_find(&mid->edges, mesh, low, high);
        if (edge < 0)
            return OST_RAISE(
                mesh->ctx, OST_INVALID_INPUT,
                "nodes %lld and %lld share a tet on another rank, but not on rank %d, which owns them; give "
                "every rank all tets that touch its nodes",
                (long long)ends[i].low, (long long)ends[i].high, ost_rank(mesh->ctx));
        answer[i] = mid->number[mesh->node_count + edge];
    }
    return OST_SUCCESS;
}

/* Asks the edges' owners for their new global numbers. */
static OstStatus ask_owners(const MidNodes *mid, OstLocal count, const Ends *ends, const int *to, OstGlobal *number)
{
    OstContext *ctx = mid->mesh->ctx;
    OstRoute *route = NULL;
    Ends *asked = NULL;
    OstGlobal *answer = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_route_create(ctx, count, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *ends, ends, (void **)&asked));
    status = OST_NEW(ctx, &answer, route->receives);
    OST_THEN(look_up(mid, route->receives, asked, answer));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_route_answer(route, sizeof *answer, answer, number));
done:
    OST_FREE(asked, answer);
    ost_route_destroy(&route);
    return status;
}

static OstStatus number_ghosts(MidNodes *mid)
{
    const OstMesh *mesh = mid->mesh;
    const OstLocal owned = mid->edges.start[mesh->owned_nodes];
    const OstLocal count = mid->edges.count - owned;
    Ends *ends = NULL;
    int *to = NULL;
    OstStatus status = OST_NEW(mesh->ctx, &ends, count);
    OST_THEN(OST_NEW(mesh->ctx, &to, count));
    OST_TRY_DONE(ost_agree(mesh->ctx, status));
    list_questions(mid, ends, to);
    status = ask_owners(mid, count, ends, to, mid->number + mesh->node_count + owned);
done:
    OST_FREE(ends, to);
    return status;
}

/* The highest label of a vertex. Raises an error if six labels for each tet do not fit in 64 bits after it. */
static OstStatus find_highest_label(const OstMesh *mesh, OstGlobal *highest)
{
    OstGlobal most[2] = {0, 0}; /* vertex label, tet label */
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        most[0] = mesh->node_label[n] > most[0] ? mesh->node_label[n] : most[0];
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        most[1] = mesh->tet_label[t] > most[1] ? mesh->tet_label[t] : most[1];
    OST_TRY(ost_max_numbers(mesh->ctx, 2, most));
    if (most[1] > (INT64_MAX - most[0]) / 8)
        return OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED,
                         "tet label %lld is too large to make the labels of new nodes and tets of; number tets from 1",
                         (long long)most[1]);
    *highest = most[0];
    return OST_SUCCESS;
}

OstGlobal ost_mid_nodes_label(const MidNodes *mid, OstLocal tet, int e)
{
    return mid->highest_label + 6 * (mid->mesh->tet_label[tet] - 1) + e + 1;
}

/* An edge gets its label from the tet with the lowest label around it. Its owner has all of these. */
static OstStatus label_nodes(MidNodes *mid)
{
    const OstMesh *mesh = mid->mesh;
    OST_TRY(find_highest_label(mesh, &mid->highest_label));
    memcpy(mid->label, mesh->node_label, (size_t)mesh->node_count * sizeof *mid->label);
    OstGlobal *label = mid->label + mesh->node_count;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int e = 0; e < 6; e++) {
            const OstLocal edge = mid->edges.of_tet[6 * (size_t)t + (size_t)e];
            const OstGlobal name = ost_mid_nodes_label(mid, t, e);
            if (label[edge] == 0 || name < label[edge])
                label[edge] = name;
        }
    }
    return OST_SUCCESS;
}

static void place_nodes(MidNodes *mid, const OstShapeSurface *shape)
{
    const OstMesh *mesh = mid->mesh;
    const double *x = mesh->coordinates;
    double *middle = mid->coordinates + 3 * (size_t)mesh->node_count;
    memcpy(mid->coordinates, x, 3 * (size_t)mesh->node_count * sizeof *x);
    for (OstLocal e = 0; e < mid->edges.count; e++, middle += 3)
        ost_shape_surface_middle(shape, x + 3 * (size_t)mid->edges.low[e], x + 3 * (size_t)mid->edges.high[e], middle);
}

OstStatus ost_mid_nodes_create(const OstMesh *mesh, const OstShapeSurface *shape, MidNodes *mid)
{
    mid->mesh = mesh;
    OstStatus status = ost_edge_table_build(mesh, &mid->edges);
    OST_THEN(allocate(mid));
    OST_TRY(ost_agree(mesh->ctx, status));
    OST_TRY(number_owned(mid));
    OST_TRY(number_ghosts(mid));
    OST_TRY(label_nodes(mid));
    place_nodes(mid, shape);
    return OST_SUCCESS;
}

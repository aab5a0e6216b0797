/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/complement/function_halo.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"

/* What is connected. */
typedef struct Items {
    const OstMesh *mesh;
    const EdgeTable *edges;
    const FaceTable *faces; /* NULL: the edges themselves */
} Items;

/* The vertices of an edge or face by their global numbers, ascending; an edge has -1 for the third. */
typedef struct Vertices {
    OstGlobal number[3];
} Vertices;

static OstStatus look_up(const Items *items, OstGlobal first, OstLocal count, const Vertices *asked, OstGlobal *answer)
{
    const OstMesh *mesh = items->mesh;
    for (OstLocal i = 0; i < count; i++) {
        OstLocal vertex[3], found = -1;
        for (int a = 0; a < 3; a++)
            vertex[a] = asked[i].number[a] < 0 ? -1 : ost_mesh_local(mesh, asked[i].number[a]);
        if (vertex[0] >= 0 && vertex[1] >= 0)
            found = ost_edge_find(items->edges, mesh, vertex[0], vertex[1]);
        if (found >= 0 && asked[i].number[2] >= 0)
            found = ost_face_find(items->faces, found, vertex[2]);
        if (found < 0)
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "vertices %lld and %lld share a tet on another rank, but not on rank %d, which owns them; "
                             "give every rank all tets that touch its vertices",
                             (long long)asked[i].number[0], (long long)asked[i].number[1], ost_rank(mesh->ctx));
        answer[i] = first + found;
    }
    return OST_SUCCESS;
}

/* Asks the ranks `to` for the numbers of edges or faces. */
static OstStatus ask(const Items *items, OstGlobal first, OstLocal count, const Vertices *vertices, const int *to,
                     OstGlobal *number)
{
    OstContext *ctx = items->mesh->ctx;
    OstRoute *route = NULL;
    Vertices *asked = NULL;
    OstGlobal *answer = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_route_create(ctx, count, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *vertices, vertices, (void **)&asked));
    status = OST_NEW(ctx, &answer, route->receives);
    OST_THEN(look_up(items, first, route->receives, asked, answer));
    OST_TRY_DONE(ost_agree(ctx, status));
    status = ost_route_answer(route, sizeof *answer, answer, number);
done:
    OST_FREE(asked);
    OST_FREE(answer);
    ost_route_destroy(&route);
    return status;
}

/* Ghost edges, or faces, and the ranks that own their lowest vertices. */
static void list_ghosts(const Items *items, Vertices *vertices, int *to)
{
    const OstMesh *mesh = items->mesh;
    const EdgeTable *edges = items->edges;
    const FaceTable *faces = items->faces;
    const OstHalo *halo = mesh->halo;
    OstLocal i = 0;
    int k = 0;
    for (OstLocal e = edges->start[mesh->owned_nodes]; e < edges->count; e++) {
        const OstLocal low = edges->low[e];
        while (low - mesh->owned_nodes >= halo->receive_start[k + 1])
            k++;
        const OstLocal begin = faces ? faces->start[e] : 0, end = faces ? faces->start[e + 1] : 1;
        for (OstLocal f = begin; f < end; f++, i++) {
            to[i] = halo->neighbour[k];
            vertices[i] = (Vertices){{mesh->node_number[low], mesh->node_number[edges->high[e]],
                                      faces ? mesh->node_number[faces->high[f]] : -1}};
        }
    }
}

OstStatus ost_function_halo(const OstMesh *mesh, const EdgeTable *edges, const FaceTable *faces, OstHalo **halo)
{
    OstContext *ctx = mesh->ctx;
    const Items items = {mesh, edges, faces};
    const OstLocal owned_edges = edges->start[mesh->owned_nodes];
    const OstLocal owned = faces ? faces->start[owned_edges] : owned_edges;
    const OstLocal ghosts = (faces ? faces->count : edges->count) - owned;
    OstGlobal first = 0, total = 0, *number = NULL;
    Vertices *vertices = NULL;
    int *to = NULL;
    OstStatus status = OST_NEW(ctx, &vertices, ghosts);
    OST_THEN(OST_NEW(ctx, &to, ghosts));
    OST_THEN(OST_NEW(ctx, &number, ghosts));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_number_from(ctx, owned, &first, &total));
    list_ghosts(&items, vertices, to);
    OST_TRY_DONE(ask(&items, first, ghosts, vertices, to, number));
    status = ost_halo_create(ctx, owned, first, ghosts, number, halo);
done:
    OST_FREE(vertices);
    OST_FREE(to);
    OST_FREE(number);
    return status;
}

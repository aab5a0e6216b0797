/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/complement_halo.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"

/* The vertices of an edge or face by their global numbers, ascending; an edge has -1 for the third. */
typedef struct Vertices {
    OstGlobal number[3];
} Vertices;

static OstStatus look_up(const OstComplement *complement, OstGlobal first, OstLocal count, const Vertices *asked,
                         OstGlobal *answer)
{
    const OstMesh *mesh = complement->mesh;
    for (OstLocal i = 0; i < count; i++) {
        OstLocal vertex[3], found = -1;
        for (int a = 0; a < 3; a++)
            vertex[a] = asked[i].number[a] < 0 ? -1 : ost_mesh_local(mesh, asked[i].number[a]);
        if (vertex[0] >= 0 && vertex[1] >= 0)
            found = ost_edge_find(&complement->edges, mesh, vertex[0], vertex[1]);
        if (found >= 0 && asked[i].number[2] >= 0)
            found = ost_complement_find_face(complement, found, vertex[2]);
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
static OstStatus ask(const OstComplement *complement, OstGlobal first, OstLocal count, const Vertices *vertices,
                     const int *to, OstGlobal *number)
{
    OstContext *ctx = complement->mesh->ctx;
    OstRoute *route = NULL;
    Vertices *asked = NULL;
    OstGlobal *answer = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_route_create(ctx, count, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *vertices, vertices, (void **)&asked));
    status = OST_NEW(ctx, &answer, route->receives);
    OST_THEN(look_up(complement, first, route->receives, asked, answer));
    OST_TRY_DONE(ost_agree(ctx, status));
    status = ost_route_answer(route, sizeof *answer, answer, number);
done:
    OST_FREE(asked);
    OST_FREE(answer);
    ost_route_destroy(&route);
    return status;
}

/* Ghost edges, or faces, and the ranks that own their lowest vertices. */
static void list_ghosts(const OstComplement *complement, int faces, Vertices *vertices, int *to)
{
    const OstMesh *mesh = complement->mesh;
    const EdgeTable *edges = &complement->edges;
    const OstHalo *halo = mesh->halo;
    OstLocal i = 0;
    int k = 0;
    for (OstLocal e = complement->owned_edges; e < edges->count; e++) {
        const OstLocal low = edges->low[e];
        while (low - mesh->owned_nodes >= halo->receive_start[k + 1])
            k++;
        const OstLocal begin = faces ? complement->face_start[e] : 0, end = faces ? complement->face_start[e + 1] : 1;
        for (OstLocal f = begin; f < end; f++, i++) {
            to[i] = halo->neighbour[k];
            vertices[i] = (Vertices){{mesh->node_number[low], mesh->node_number[edges->high[e]],
                                      faces ? mesh->node_number[complement->face_high[f]] : -1}};
        }
    }
}

static OstStatus connect(const OstComplement *complement, int faces, OstLocal owned, OstLocal count, OstHalo **halo)
{
    OstContext *ctx = complement->mesh->ctx;
    const OstLocal ghosts = count - owned;
    OstGlobal first = 0, total = 0, *number = NULL;
    Vertices *vertices = NULL;
    int *to = NULL;
    OstStatus status = OST_NEW(ctx, &vertices, ghosts);
    OST_THEN(OST_NEW(ctx, &to, ghosts));
    OST_THEN(OST_NEW(ctx, &number, ghosts));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_number_from(ctx, owned, &first, &total));
    list_ghosts(complement, faces, vertices, to);
    OST_TRY_DONE(ask(complement, first, ghosts, vertices, to, number));
    status = ost_halo_create(ctx, owned, first, ghosts, number, halo);
done:
    OST_FREE(vertices);
    OST_FREE(to);
    OST_FREE(number);
    return status;
}

OstStatus ost_complement_connect(OstComplement *complement)
{
    OST_TRY(connect(complement, 0, complement->owned_edges, complement->edges.count, &complement->edge_halo));
    if (complement->mesh->nodes_per_tet != 10)
        return OST_SUCCESS;
    return connect(complement, 1, complement->owned_faces, complement->face_count, &complement->face_halo);
}

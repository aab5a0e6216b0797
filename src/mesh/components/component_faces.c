/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/components/component_faces.h"

#include "core/error.h"
#include "core/memory.h"
#include "mesh/union_find.h"

/* A face in the chain of faces with the same lowest vertex. Faces and tets are counted from 1: 0 is none, so that
 * zeroed memory is an empty table. */
typedef struct Face {
    OstLocal middle, high; /* its other vertices */
    OstLocal next;
    OstLocal side[2]; /* tets seen from outside of which its vertices ascend counter-clockwise, and clockwise */
} Face;

typedef struct FaceChains {
    OstLocal *first; /* owned_nodes */
    Face *face;      /* from 1 */
    OstLocal count;
} FaceChains;

/* A tet's vertices in ascending order; `turned` tells whether that took an odd number of swaps. */
static void sort_vertices(const OstLocal *tet, OstLocal v[4], int *turned)
{
    static const int network[5][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}};
    *turned = 0;
    for (int i = 0; i < 4; i++)
        v[i] = tet[i];
    for (int i = 0; i < 5; i++) {
        const int a = network[i][0];
        const int b = network[i][1];
        const int swap = v[a] > v[b];
        const OstLocal low = swap ? v[b] : v[a];
        v[b] = swap ? v[a] : v[b];
        v[a] = low;
        *turned ^= swap;
    }
}

/* Room for the four faces of another tet. */
static OstStatus make_room(OstContext *ctx, FaceChains *chains)
{
    if (chains->count >= INT32_MAX - 4)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "the tets of one rank have more than %d faces; use more ranks",
                         INT32_MAX);
    return OST_GROW(ctx, &chains->face, chains->count + 5);
}

static void note_overlap(const OstMesh *mesh, OstLocal s, OstLocal t, OstOverlap *overlap)
{
    const OstGlobal a = mesh->tet_label[s];
    const OstGlobal b = mesh->tet_label[t];
    const OstGlobal low = a < b ? a : b;
    const OstGlobal high = a < b ? b : a;
    if (overlap->found && (low > overlap->low || (low == overlap->low && high >= overlap->high)))
        return;
    *overlap = (OstOverlap){1, low, high};
}

/* Adds a tet's face to the chains, and joins the tet with the one behind it. */
static void add_face(const OstMesh *mesh, FaceChains *chains, OstLocal low, OstLocal middle, OstLocal high, int side,
                     OstLocal tet, OstLocal *parent, OstOverlap *overlap)
{
    OstLocal f = chains->first[low];
    while (f > 0 && (chains->face[f].middle != middle || chains->face[f].high != high))
        f = chains->face[f].next;
    if (f == 0) {
        f = ++chains->count;
        chains->face[f] = (Face){middle, high, chains->first[low], {0, 0}};
        chains->first[low] = f;
    }
    Face *face = &chains->face[f];
    if (face->side[side] > 0)
        note_overlap(mesh, face->side[side] - 1, tet, overlap);
    else
        face->side[side] = tet + 1;
    if (face->side[!side] > 0)
        ost_set_join(parent, face->side[!side] - 1, tet);
}

static OstStatus add_all_faces(const OstMesh *mesh, FaceChains *chains, OstLocal *parent, OstOverlap *overlap)
{
    const size_t width = (size_t)mesh->nodes_per_tet;
    const OstLocal owned = mesh->owned_nodes;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        OstLocal v[4];
        int turned;
        OST_TRY(make_room(mesh->ctx, chains));
        sort_vertices(mesh->tet_nodes + (size_t)t * width, v, &turned);
        if (v[0] < owned) { /* owned nodes have the lowest numbers, so a face's lowest vertex decides */
            add_face(mesh, chains, v[0], v[1], v[2], turned, t, parent, overlap);
            add_face(mesh, chains, v[0], v[1], v[3], !turned, t, parent, overlap);
            add_face(mesh, chains, v[0], v[2], v[3], turned, t, parent, overlap);
        }
        if (v[1] < owned)
            add_face(mesh, chains, v[1], v[2], v[3], !turned, t, parent, overlap);
    }
    return OST_SUCCESS;
}

/* The vertices of faces with a tet on one side alone. What is kept follows from the mesh, which it does not change. */
static OstStatus keep_surface(const OstMesh *mesh, const FaceChains *chains)
{
    unsigned char *at_surface = NULL;
    OST_TRY(OST_NEW(mesh->ctx, &at_surface, mesh->node_count));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        for (OstLocal f = chains->first[n]; f > 0; f = chains->face[f].next) {
            const Face *face = &chains->face[f];
            if (!face->side[0] || !face->side[1])
                at_surface[n] = at_surface[face->middle] = at_surface[face->high] = 1;
        }
    ((OstMesh *)mesh)->at_surface = at_surface;
    return OST_SUCCESS;
}

OstStatus ost_component_faces_join(const OstMesh *mesh, OstLocal *set, OstLocal *set_count, OstOverlap *overlap)
{
    FaceChains chains = {0};
    OstStatus status = OST_SUCCESS;
    *overlap = (OstOverlap){0};
    ost_set_start(set, mesh->tet_count);
    OST_TRY_DONE(OST_NEW(mesh->ctx, &chains.first, mesh->owned_nodes));
    /* Twice as many faces as tets, and some more for the surface. */
    OST_TRY_DONE(OST_NEW(mesh->ctx, &chains.face, (size_t)mesh->tet_count / 4 * 9 + 64));
    OST_TRY_DONE(add_all_faces(mesh, &chains, set, overlap));
    *set_count = ost_set_number(set, mesh->tet_count);
    if (!mesh->at_surface)
        OST_TRY_DONE(keep_surface(mesh, &chains));
done:
    OST_FREE(chains.first, chains.face);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/check/check.h"

#include <math.h>

static double *node_at(const OstMesh *mesh, OstLocal tet, int node)
{
    return mesh->coordinates + 3 * (size_t)mesh->tet_nodes[10 * (size_t)tet + (size_t)node];
}

/* The determinant of the map from the reference tet at a vertex v: of the tangents 4 m - 3 v - w to the three edges vw
 * with middles m. */
static double jacobian_at(const OstMesh *mesh, OstLocal tet, int vertex)
{
    double tangent[9];
    const double *v = node_at(mesh, tet, vertex);
    for (int i = 0; i < 3; i++) {
        const int other = ost_tet_face[vertex][i];
        const double *w = node_at(mesh, tet, other);
        const double *m = node_at(mesh, tet, ost_tet_mid_node(vertex, other));
        for (int d = 0; d < 3; d++)
            tangent[3 * i + d] = 4.0 * (m[d] - v[d]) - (w[d] - v[d]);
    }
    return ost_determinant3(tangent);
}

/* Does the tet fold at a vertex? Then at which the most, and how far: that determinant over the straight tet's. */
static int folds(const OstMesh *mesh, OstLocal tet, int *vertex, double *share)
{
    double least = INFINITY;
    for (int v = 0; v < 4; v++) {
        const double jacobian = jacobian_at(mesh, tet, v);
        if (!(jacobian >= least)) {
            least = jacobian;
            *vertex = v;
        }
    }
    *share = least / (6.0 * ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet)));
    return !(least > 0.0);
}

/* Folded tets of the whole mesh, and the one that folds most. */
typedef struct Folds {
    OstGlobal count;
    double share;          /* of the worst; the same on all ranks, as all that follows */
    OstGlobal tet, vertex; /* labels */
} Folds;

/* Collective. Marks this rank's folded tets, ghosts too. */
static OstStatus find_folds(const OstMesh *mesh, char *folded, Folds *found)
{
    OstGlobal label[2] = {INT64_MAX, INT64_MAX};
    double worst = INFINITY;
    found->count = 0;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        int vertex = 0;
        double share = 0.0;
        folded[t] = (char)folds(mesh, t, &vertex, &share);
        if (!folded[t] || t >= mesh->owned_tets)
            continue;
        found->count++;
        if (share < worst || (share == worst && mesh->tet_label[t] < label[0])) {
            worst = share;
            label[0] = mesh->tet_label[t];
            label[1] = mesh->node_label[mesh->tet_nodes[10 * (size_t)t + (size_t)vertex]];
        }
    }
    found->share = worst;
    OST_TRY(ost_min(mesh->ctx, 1, &found->share));
    if (worst != found->share)
        label[0] = INT64_MAX;
    found->tet = label[0];
    OST_TRY(ost_min_numbers(mesh->ctx, 1, &found->tet));
    found->vertex = label[0] == found->tet ? label[1] : INT64_MAX;
    OST_TRY(ost_min_numbers(mesh->ctx, 1, &found->vertex));
    return ost_sum_numbers(mesh->ctx, 1, &found->count);
}

/* Collective. Puts the mid-edge nodes of marked tets on the straight middles; owners, which have all tets around their
 * nodes, send them to ghosts. *moved: did any node of the mesh move? */
static OstStatus straighten(OstMesh *mesh, const char *folded, OstGlobal *moved)
{
    *moved = 0;
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int e = 0; folded[t] && e < 6; e++) {
            const double *a = node_at(mesh, t, ost_tet_edge[e][0]), *b = node_at(mesh, t, ost_tet_edge[e][1]);
            double *middle = node_at(mesh, t, 4 + e);
            for (int d = 0; d < 3; d++) {
                const double straight = 0.5 * a[d] + 0.5 * b[d]; /* the same from b to a */
                *moved |= middle[d] != straight;
                middle[d] = straight;
            }
        }
    OST_TRY(ost_max_numbers(mesh->ctx, 1, moved));
    return ost_agree(mesh->ctx, ost_halo_import(mesh->halo, 3 * sizeof(double), mesh->coordinates));
}

static OstStatus raise_fold(const OstMesh *mesh, const Folds *found)
{
    char cell[OST_CELL_WORDS];
    return OST_RAISE(
        mesh->ctx, OST_INVALID_INPUT,
        "tet %lld%s with curved edges folds over at its vertex %lld, the worst of %lld such tets; give "
        "them straight edges (element: {straighten: true} in a case, --straighten of 'orthostat mesh'), or refine "
        "the mesh where it is made",
        (long long)found->tet, ost_cell_words(mesh, found->tet, cell), (long long)found->vertex,
        (long long)found->count);
}

/* A straight edge may fold a tet beside it that was not: again, until none folds or nothing moves. */
static OstStatus check_or_straighten(OstMesh *mesh, char *folded)
{
    Folds first, found;
    OstGlobal mended = 0, moved = 0;
    OST_TRY(find_folds(mesh, folded, &first));
    for (found = first; found.count > 0;) {
        mended += found.count;
        if (mesh->straighten)
            OST_TRY(straighten(mesh, folded, &moved));
        if (!moved)
            return raise_fold(mesh, &found);
        OST_TRY(find_folds(mesh, folded, &found));
    }
    if (mended > 0)
        ost_warn(mesh->ctx,
                 "straighten: the edges of %lld curved %s that folded over are now straight; the worst, tet %lld at "
                 "vertex %lld, had %.2g times the volume of the straight tet there",
                 (long long)mended, mended == 1 ? "tet" : "tets", (long long)first.tet, (long long)first.vertex,
                 first.share);
    return OST_SUCCESS;
}

OstStatus ost_check_folds(OstMesh *mesh)
{
    char *folded = NULL;
    OstStatus status = ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &folded, mesh->tet_count));
    OST_THEN(check_or_straighten(mesh, folded));
    OST_FREE(folded);
    return status;
}

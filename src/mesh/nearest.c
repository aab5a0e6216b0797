/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/nearest.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double *point_of(const OstMesh *mesh, OstLocal node)
{
    return mesh->coordinates + 3 * (size_t)node;
}

static double distance(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return ost_norm3(d);
}

static void keep_nearer(const OstMesh *mesh, const double place[3], OstLocal node, OstNearest *vertex)
{
    const double away = distance(point_of(mesh, node), place);
    if (away > vertex->distance)
        return;
    if (away == vertex->distance && vertex->node >= 0 && mesh->node_label[node] >= mesh->node_label[vertex->node])
        return;
    vertex->distance = away;
    vertex->node = node;
}

static OstStatus agree_on_vertex(const OstMesh *mesh, OstNearest *vertex)
{
    OstContext *ctx = mesh->ctx;
    double nearest = vertex->distance;
    OST_TRY(ost_min(ctx, 1, &nearest));
    const int candidate = vertex->node >= 0 && vertex->distance == nearest;
    const OstGlobal label = candidate ? mesh->node_label[vertex->node] : INT64_MAX;
    OstGlobal lowest = label;
    OST_TRY(ost_min_numbers(ctx, 1, &lowest));
    const int chosen = candidate && label == lowest;
    vertex->owner = chosen ? ost_rank(ctx) : -1;
    OST_TRY(ost_max_ints(ctx, 1, &vertex->owner));
    vertex->distance = nearest;
    if (!chosen)
        vertex->node = -1;
    return OST_SUCCESS;
}

OstStatus ost_mesh_nearest(const OstMesh *mesh, const double place[3], OstNearest *vertex)
{
    vertex->node = -1;
    vertex->distance = DBL_MAX;
    for (OstLocal node = 0; mesh->nodes_per_tet == 4 && node < mesh->owned_nodes; node++) /* all are vertices */
        keep_nearer(mesh, place, node, vertex);
    for (OstLocal t = 0; mesh->nodes_per_tet > 4 && t < mesh->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            const OstLocal node = ost_mesh_nodes_of(mesh, t)[k];
            if (node < mesh->owned_nodes)
                keep_nearer(mesh, place, node, vertex);
        }
    OST_TRY(agree_on_vertex(mesh, vertex));
    if (vertex->node >= 0)
        memcpy(vertex->at, point_of(mesh, vertex->node), sizeof vertex->at);
    return OST_MPI(mesh->ctx, MPI_Bcast(vertex->at, 3, MPI_DOUBLE, vertex->owner, ost_comm(mesh->ctx)));
}

OstStatus ost_mesh_edges_at(const OstMesh *mesh, const OstNearest *vertex, double *shortest, double *longest)
{
    double edge[2] = {DBL_MAX, 0.0};
    for (OstLocal t = 0; vertex->node >= 0 && t < mesh->tet_count; t++) { /* its owner holds all its tets */
        const OstLocal *corner = ost_mesh_nodes_of(mesh, t);
        if (corner[0] != vertex->node && corner[1] != vertex->node && corner[2] != vertex->node &&
            corner[3] != vertex->node)
            continue;
        for (int k = 0; k < 4; k++)
            if (corner[k] != vertex->node) {
                const double length = distance(point_of(mesh, corner[k]), vertex->at);
                edge[0] = fmin(edge[0], length);
                edge[1] = fmax(edge[1], length);
            }
    }
    OST_TRY(OST_MPI(mesh->ctx, MPI_Bcast(edge, 2, MPI_DOUBLE, vertex->owner, ost_comm(mesh->ctx))));
    *shortest = edge[0];
    *longest = edge[1];
    return OST_SUCCESS;
}

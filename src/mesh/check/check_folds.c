/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/check/check.h"
#include "mesh/tet.h"

static const double *node_at(const OstMesh *mesh, OstLocal tet, int node)
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

/* The message names the folded tet with the lowest label of all ranks. */
OstStatus ost_check_folds(const OstMesh *mesh)
{
    OstGlobal lowest = INT64_MAX;
    OstLocal worst = -1;
    int at = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        for (int v = 0; v < 4; v++)
            if (mesh->tet_label[t] < lowest && !(jacobian_at(mesh, t, v) > 0.0)) {
                lowest = mesh->tet_label[t];
                worst = t;
                at = v;
            }
    const OstGlobal mine = lowest;
    OST_TRY(ost_min_numbers(mesh->ctx, 1, &lowest));
    OstStatus status = OST_SUCCESS;
    if (worst >= 0 && mine == lowest)
        status = OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                           "tet %lld with curved edges folds over at its vertex %lld; refine the mesh first, or keep "
                           "its edges straight",
                           (long long)lowest, (long long)mesh->node_label[mesh->tet_nodes[10 * worst + at]]);
    return ost_agree(mesh->ctx, status);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "mesh/mesh_data.h"

int ost_tet_mid_node(int a, int b)
{
    int e = 0;
    while (
        !((ost_tet_edge[e][0] == a && ost_tet_edge[e][1] == b) || (ost_tet_edge[e][0] == b && ost_tet_edge[e][1] == a)))
        e++;
    return 4 + e;
}

void ost_tet_node_place(int node, double place[4])
{
    for (int v = 0; v < 4; v++)
        place[v] = node == v ? 1.0 : 0.0;
    if (node >= 4) {
        place[ost_tet_edge[node - 4][0]] = 0.5;
        place[ost_tet_edge[node - 4][1]] = 0.5;
    }
}

static void difference(const double *from, const double *to, double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = to[i] - from[i];
}

double ost_tet_volume(const double *coordinates, const OstLocal *nodes)
{
    double edge[9];
    for (int v = 1; v < 4; v++)
        difference(coordinates + 3 * (size_t)nodes[0], coordinates + 3 * (size_t)nodes[v], edge + 3 * (v - 1));
    return ost_determinant3(edge) / 6.0;
}

double ost_tet_quality(const double *coordinates, const OstLocal *nodes)
{
    double sum = 0.0;
    for (int e = 0; e < 6; e++) {
        double edge[3];
        difference(coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]],
                   coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]], edge);
        sum += ost_norm3(edge);
    }
    const double mean = sum / 6.0;
    return mean > 0.0 ? 6.0 * sqrt(2.0) * (ost_tet_volume(coordinates, nodes) / mean / mean / mean) : 0.0;
}

OstStatus ost_mesh_tet_centroids(const OstMesh *mesh, double *centroids)
{
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        for (size_t d = 0; d < 3; d++) {
            double sum = 0.0;
            for (int v = 0; v < 4; v++)
                sum += mesh->coordinates[3 * (size_t)nodes[v] + d];
            centroids[3 * (size_t)t + d] = 0.25 * sum;
        }
    }
    return OST_SUCCESS;
}

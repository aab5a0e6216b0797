/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/flat/stacks.h"
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>

/* Two edges of each face, as ost_tet_edge has them; the first face's begin at vertex 0, as edge 3 does. */
static const int two_of_face[4][2] = {{0, 2}, {0, 3}, {2, 3}, {1, 4}};

/* A tet's longest edge over its least altitude: that on the largest face. */
static double longest_over_least(const OstMesh *mesh, const OstLocal *node)
{
    double side[6][3], area[3], longest = 0.0, largest = 0.0;
    for (int e = 0; e < 6; e++) {
        const double *from = mesh->coordinates + 3 * node[ost_tet_edge[e][0]];
        const double *to = mesh->coordinates + 3 * node[ost_tet_edge[e][1]];
        for (int i = 0; i < 3; i++)
            side[e][i] = to[i] - from[i];
        longest = fmax(longest, ost_norm3(side[e]));
    }
    for (int face = 0; face < 4; face++) {
        ost_cross3(side[two_of_face[face][0]], side[two_of_face[face][1]], area);
        largest = fmax(largest, ost_norm3(area));
    }
    ost_cross3(side[two_of_face[0][0]], side[two_of_face[0][1]], area);
    const double volume = fabs(ost_dot3(area, side[3]));
    return longest * largest / volume;
}

OstStatus ost_flatness(const OstMesh *mesh, double *flatness)
{
    static const double of_cube = 2.449489742783178; /* sqrt(6) */
    double sum[2] = {0.0};
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        const double of_tet = longest_over_least(mesh, ost_mesh_nodes_of(mesh, tet)) / of_cube;
        sum[0] += isfinite(of_tet) ? log(of_tet) : 0.0;
        sum[1] += 1.0;
    }
    OST_TRY(ost_sum(mesh->ctx, 2, sum));
    *flatness = exp(sum[0] / sum[1]);
    return OST_SUCCESS;
}

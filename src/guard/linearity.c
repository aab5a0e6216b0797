/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/linearity.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/strain_batch.h"
#include "mesh/mesh_data.h"

#include <string.h>

/* Four vectors with the mean gradient of the displacement as their linear map, up to a factor: in the mean gradient of
 * a quadratic tet's shape functions only mid-edge nodes appear, each as the sum of its two ends'. */
static void at_corners(int nodes, const OstSimd *u, OstSimd corners[12])
{
    if (nodes == 4) {
        memcpy(corners, u, 12 * sizeof *u);
        return;
    }
    memset(corners, 0, 12 * sizeof *corners);
    for (int e = 0; e < 6; e++)
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < 3; i++)
                corners[3 * ost_tet_edge[e][end] + i] += u[3 * (4 + e) + i];
}

static void find_edges(int nodes, const OstSimd *vectors, OstSimd edges[3][3])
{
    OstSimd corners[12];
    at_corners(nodes, vectors, corners);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            edges[k][i] = corners[3 * (k + 1) + i] - corners[i];
}

/* Half the curl. The gradient is that of u's corners over x's: where u is linear it is right, in curved tets too. */
static void find_rotation(const OstBatch *batch, int nodes, const OstSimd *u, OstSimd rotation[3])
{
    OstSimd x[3][3], moved[3][3], inverse[3][3];
    find_edges(nodes, batch->x, x);
    find_edges(nodes, u, moved);
    for (int k = 0; k < 3; k++)
        ost_simd_cross(x[(k + 1) % 3], x[(k + 2) % 3], inverse[k]);
    const OstSimd determinant = x[0][0] * inverse[0][0] + x[0][1] * inverse[0][1] + x[0][2] * inverse[0][2];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int l = (i + 2) % 3;
        rotation[i] = (OstSimd){0};
        for (int k = 0; k < 3; k++) /* du_l/dx_j - du_j/dx_l */
            rotation[i] += moved[k][l] * inverse[k][j] - moved[k][j] * inverse[k][l];
        rotation[i] *= 0.5 / determinant;
    }
}

/* The eigenvalue of a strain with the largest absolute value, by the trigonometric solution of the cubic. */
static double principal(const double e[6])
{
    const double mean = (e[0] + e[1] + e[2]) / 3.0;
    const double d[3] = {e[0] - mean, e[1] - mean, e[2] - mean};
    const double s[3] = {0.5 * e[3], 0.5 * e[4], 0.5 * e[5]}; /* 12 23 31 */
    const double size = sqrt((ost_dot3(d, d) + 2.0 * ost_dot3(s, s)) / 6.0);
    if (size == 0.0)
        return fabs(mean);
    const double determinant =
        d[0] * (d[1] * d[2] - s[1] * s[1]) - s[0] * (s[0] * d[2] - s[1] * s[2]) + s[2] * (s[0] * s[1] - d[1] * s[2]);
    const double angle = acos(fmax(fmin(0.5 * determinant / (size * size * size), 1.0), -1.0)) / 3.0;
    const double third = 2.0943951023931957; /* 2 pi / 3 */
    return fmax(fabs(mean + 2.0 * size * cos(angle)), fabs(mean + 2.0 * size * cos(angle + third)));
}

static void add_tet(const OstSimd strain[6], const OstSimd rotation[3], int slot, OstLinearity *largest)
{
    double e[6], w[3], square = 0.0;
    for (int p = 0; p < 6; p++) {
        e[p] = strain[p][slot];
        square += (p < 3 ? 1.0 : 0.5) * e[p] * e[p];
    }
    for (int i = 0; i < 3; i++)
        w[i] = rotation[i][slot];
    largest->rotation = fmax(largest->rotation, ost_norm3(w));
    if (square > largest->strain * largest->strain) /* no eigenvalue exceeds the square root */
        largest->strain = fmax(largest->strain, principal(e));
}

void ost_linearity_add(const OstBatch *batch, const OstElement *element, const OstSimd *u, const OstMeans *means,
                       OstLinearity *largest)
{
    OstSimd rotation[3];
    find_rotation(batch, element->nodes, u, rotation);
    for (int slot = 0; slot < batch->count; slot++)
        add_tet(means->strain, rotation, slot, largest);
}

OstStatus ost_linearity_agree(OstContext *ctx, OstLinearity *largest)
{
    double both[2] = {largest->strain, largest->rotation};
    OST_TRY(ost_max(ctx, 2, both));
    *largest = (OstLinearity){both[0], both[1]};
    return OST_SUCCESS;
}

static void visit(void *largest, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                  const OstMeans *means)
{
    ost_linearity_add(batch, element, u, means, largest);
}

OstStatus ost_linearity_of(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstLinearity *largest)
{
    *largest = (OstLinearity){0.0, 0.0};
    ost_visit_means(mesh, field, u, visit, largest);
    return ost_linearity_agree(mesh->ctx, largest);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/tet4.h"

#include "core/small.h"

/* Where C_pq is in the upper triangle. */
static const int upper[6][6] = {{0, 1, 2, 3, 4, 5},     {1, 6, 7, 8, 9, 10},    {2, 7, 11, 12, 13, 14},
                                {3, 8, 12, 15, 16, 17}, {4, 9, 13, 16, 18, 19}, {5, 10, 14, 17, 19, 20}};

/* The first row of pair (a, b), a <= b, among the ten blocks. */
static const int pair[4][4] = {{0, 9, 18, 27}, {0, 36, 45, 54}, {0, 0, 63, 72}, {0, 0, 0, 81}};

double ost_tet4_gradients(const double x[12], double gradients[12])
{
    double edge[3][3];
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++)
            edge[a][i] = x[3 * (a + 1) + i] - x[i];
    ost_cross3(edge[1], edge[2], gradients + 3);
    ost_cross3(edge[2], edge[0], gradients + 6);
    ost_cross3(edge[0], edge[1], gradients + 9);
    const double determinant = ost_dot3(edge[0], gradients + 3);
    for (int i = 0; i < 3; i++) {
        for (int a = 1; a < 4; a++)
            gradients[3 * a + i] /= determinant;
        gradients[i] = -(gradients[3 + i] + gradients[6 + i] + gradients[9 + i]);
    }
    return determinant / 6.0;
}

static inline void cross_lanes(const OstLanes a[3], const OstLanes b[3], OstLanes c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* a = |a|. (Lanes go by pointer: by value, their passing would depend on the processor.) */
static inline void make_absolute(OstLanes *a)
{
    for (int lane = 0; lane < OST_LANES; lane++)
        (*a)[lane] = fabs((*a)[lane]);
}

/* Gradients of the shape functions of nodes 1 to 3 times the determinant d; node 0's is minus their sum. `factor` is
 * the volume |d|/6 times the 1/d of each of the two gradients in a product. */
static inline void scaled_gradients(const OstLanes *x, OstLanes gradient[3][3], OstLanes *factor)
{
    OstLanes edge[3][3];
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++)
            edge[a][i] = x[3 * (a + 1) + i] - x[i];
    cross_lanes(edge[1], edge[2], gradient[0]);
    cross_lanes(edge[2], edge[0], gradient[1]);
    cross_lanes(edge[0], edge[1], gradient[2]);
    OstLanes determinant = edge[0][0] * gradient[0][0] + edge[0][1] * gradient[0][1] + edge[0][2] * gradient[0][2];
    make_absolute(&determinant);
    *factor = 1.0 / (6.0 * determinant);
}

/* Stress (6) for each displacement component (3) of a node with gradient g: C times the node's columns of B. */
static inline void stress_columns(const OstLanes *c, const OstLanes g[3], OstLanes stress[6][3])
{
    for (int p = 0; p < 6; p++) {
        const int *row = upper[p];
        stress[p][0] = c[row[0]] * g[0] + c[row[3]] * g[1] + c[row[5]] * g[2];
        stress[p][1] = c[row[3]] * g[0] + c[row[1]] * g[1] + c[row[4]] * g[2];
        stress[p][2] = c[row[5]] * g[0] + c[row[4]] * g[1] + c[row[2]] * g[2];
    }
}

/* Transposed columns of B times stresses. */
static inline void block_of(const OstLanes g[3], OstLanes stress[6][3], OstLanes *block)
{
    for (int j = 0; j < 3; j++) {
        block[j] = g[0] * stress[0][j] + g[1] * stress[3][j] + g[2] * stress[5][j];
        block[3 + j] = g[0] * stress[3][j] + g[1] * stress[1][j] + g[2] * stress[4][j];
        block[6 + j] = g[0] * stress[5][j] + g[1] * stress[4][j] + g[2] * stress[2][j];
    }
}

/* Rigid translations are free of force, so node 0's blocks are minus sums of the others'. */
static inline void complete_by_translations(OstLanes *k)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int n = 3 * i + j;
            const int t = 3 * j + i;
            k[pair[0][1] + n] = -(k[pair[1][1] + n] + k[pair[1][2] + t] + k[pair[1][3] + t]);
            k[pair[0][2] + n] = -(k[pair[1][2] + n] + k[pair[2][2] + n] + k[pair[2][3] + t]);
            k[pair[0][3] + n] = -(k[pair[1][3] + n] + k[pair[2][3] + n] + k[pair[3][3] + n]);
        }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int t = 3 * j + i;
            k[3 * i + j] = -(k[pair[0][1] + t] + k[pair[0][2] + t] + k[pair[0][3] + t]);
        }
}

static void tet4_stiffness(const OstLanes *x, const OstLanes *elasticity, OstLanes *blocks)
{
    OstLanes gradient[3][3];
    OstLanes factor;
    scaled_gradients(x, gradient, &factor);
    for (int b = 0; b < 3; b++) {
        OstLanes stress[6][3];
        const OstLanes scaled[3] = {factor * gradient[b][0], factor * gradient[b][1], factor * gradient[b][2]};
        stress_columns(elasticity, scaled, stress);
        for (int a = 0; a <= b; a++)
            block_of(gradient[a], stress, blocks + pair[a + 1][b + 1]);
    }
    complete_by_translations(blocks);
}

static inline void strain_lanes(OstLanes gradient[3][3], const OstLanes *u, OstLanes strain[6])
{
    OstLanes slope[3][3]; /* du_i / dx_j */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[i][j] = (u[3 + i] - u[i]) * gradient[0][j] + (u[6 + i] - u[i]) * gradient[1][j] +
                          (u[9 + i] - u[i]) * gradient[2][j];
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = slope[i][i];
        strain[3 + i] = slope[i][next] + slope[next][i];
    }
}

/* A node's three columns of B, transposed, times a stress. */
static inline void force_of(const OstLanes g[3], const OstLanes stress[6], OstLanes force[3])
{
    force[0] = g[0] * stress[0] + g[1] * stress[3] + g[2] * stress[5];
    force[1] = g[0] * stress[3] + g[1] * stress[1] + g[2] * stress[4];
    force[2] = g[0] * stress[5] + g[1] * stress[4] + g[2] * stress[2];
}

static void tet4_force(const OstLanes *x, const OstLanes *elasticity, const OstLanes *u, OstLanes *force)
{
    OstLanes gradient[3][3];
    OstLanes strain[6];
    OstLanes stress[6];
    OstLanes factor;
    scaled_gradients(x, gradient, &factor);
    strain_lanes(gradient, u, strain);
    for (int p = 0; p < 6; p++) {
        stress[p] = elasticity[upper[p][0]] * strain[0];
        for (int q = 1; q < 6; q++)
            stress[p] += elasticity[upper[p][q]] * strain[q];
        stress[p] *= factor;
    }
    for (int a = 1; a < 4; a++)
        force_of(gradient[a - 1], stress, force + 3 * a);
    for (int i = 0; i < 3; i++)
        force[i] = -(force[3 + i] + force[6 + i] + force[9 + i]);
}

static void tet4_magnitude(const OstLanes *x, const OstLanes *elasticity, const OstLanes *u, OstLanes *magnitude)
{
    OstLanes g[4][3];
    OstLanes strain[6] = {{0}};
    OstLanes stress[6] = {{0}};
    OstLanes factor;
    scaled_gradients(x, g + 1, &factor);
    for (int i = 0; i < 3; i++)
        g[0][i] = g[1][i] + g[2][i] + g[3][i];
    for (int a = 0; a < 4; a++) {
        OstLanes size[3] = {u[3 * a], u[3 * a + 1], u[3 * a + 2]};
        for (int i = 0; i < 3; i++) {
            make_absolute(&g[a][i]);
            make_absolute(&size[i]);
        }
        for (int i = 0; i < 3; i++) {
            const int next = (i + 1) % 3;
            strain[i] += g[a][i] * size[i];
            strain[3 + i] += g[a][next] * size[i] + g[a][i] * size[next];
        }
    }
    for (int p = 0; p < 6; p++)
        for (int q = 0; q < 6; q++) {
            OstLanes c = elasticity[upper[p][q]];
            make_absolute(&c);
            stress[p] += factor * c * strain[q];
        }
    for (int a = 0; a < 4; a++)
        force_of(g[a], stress, magnitude + 3 * a);
}

static double tet4_volume(const double *x)
{
    double gradients[12];
    return ost_tet4_gradients(x, gradients);
}

static void tet4_gradient(const double *x, const double *u, double gradient[9])
{
    double gradients[12];
    ost_tet4_gradients(x, gradients);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            gradient[3 * i + j] = 0.0;
            for (int a = 1; a < 4; a++)
                gradient[3 * i + j] += (u[3 * a + i] - u[i]) * gradients[3 * a + j];
        }
}

static void tet4_strain(const double *x, const double *u, double strain[6])
{
    double gradient[9];
    tet4_gradient(x, u, gradient);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = gradient[4 * i];
        strain[3 + i] = gradient[3 * i + next] + gradient[3 * next + i];
    }
}

static void tet4_laplacian(const double *x, double *pairs)
{
    double gradients[12];
    const double volume = fabs(ost_tet4_gradients(x, gradients));
    for (int a = 0, n = 0; a < 4; a++)
        for (int b = a; b < 4; b++)
            pairs[n++] = volume * ost_dot3(gradients + 3 * a, gradients + 3 * b);
}

static void tet4_node_volumes(const double *x, double *volumes)
{
    const double quarter = fabs(tet4_volume(x)) / 4.0;
    for (int a = 0; a < 4; a++)
        volumes[a] = quarter;
}

static void tet4_node_areas(const double *x, double *areas, double *area_vectors)
{
    double edge[2][3];
    double cross[3];
    for (int i = 0; i < 3; i++) {
        edge[0][i] = x[3 + i] - x[i];
        edge[1][i] = x[6 + i] - x[i];
    }
    ost_cross3(edge[0], edge[1], cross);
    for (int a = 0; a < 3; a++) {
        areas[a] = ost_norm3(cross) / 6.0;
        for (int i = 0; i < 3; i++)
            area_vectors[3 * a + i] = cross[i] / 6.0;
    }
}

const OstElement ost_tet4 = {
    .nodes = 4,
    .nodes_per_face = 3,
    .stiffness = tet4_stiffness,
    .force = tet4_force,
    .magnitude = tet4_magnitude,
    .volume = tet4_volume,
    .gradient = tet4_gradient,
    .strain = tet4_strain,
    .laplacian = tet4_laplacian,
    .node_volumes = tet4_node_volumes,
    .node_areas = tet4_node_areas,
};

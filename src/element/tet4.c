/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/tets.h"

#include "core/kernel.h"
#include "core/small.h"
#include "element/strain_batch.h"

/* Where the block of nodes a <= b starts among the ten. */
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

/* Gradients of nodes 1 to 3 times the determinant d; node 0's is minus their sum. `factor` is |d|/6 / d², for products
 * of two of these gradients, integrated over the tet. */
static inline void scaled_gradients(const OstSimd *x, OstSimd gradient[3][3], OstSimd *factor)
{
    OstSimd edge[3][3];
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++)
            edge[a][i] = x[3 * (a + 1) + i] - x[i];
    ost_simd_cross(edge[1], edge[2], gradient[0]);
    ost_simd_cross(edge[2], edge[0], gradient[1]);
    ost_simd_cross(edge[0], edge[1], gradient[2]);
    OstSimd determinant = edge[0][0] * gradient[0][0] + edge[0][1] * gradient[0][1] + edge[0][2] * gradient[0][2];
    ost_simd_absolute(&determinant);
    *factor = 1.0 / (6.0 * determinant);
}

/* A translation makes no force, so node 0's blocks are minus the sums of the others'. */
static inline void complete_by_translations(OstSimd *k)
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

OST_KERNEL void ost_tet4_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks)
{
    OstSimd gradient[3][3];
    OstSimd factor;
    scaled_gradients(x, gradient, &factor);
    for (int b = 0; b < 3; b++) {
        OstSimd stress[6][3];
        const OstSimd scaled[3] = {factor * gradient[b][0], factor * gradient[b][1], factor * gradient[b][2]};
        ost_stress_columns(c, scaled, stress);
        for (int a = 0; a <= b; a++)
            ost_block_of_stress(gradient[a], stress, blocks + pair[a + 1][b + 1]);
    }
    complete_by_translations(blocks);
}

/* stretched = A g */
static inline void stretch_gradient(const OstSimd tensor[6], const OstSimd g[3], OstSimd stretched[3])
{
    stretched[0] = tensor[0] * g[0] + tensor[3] * g[1] + tensor[5] * g[2];
    stretched[1] = tensor[3] * g[0] + tensor[1] * g[1] + tensor[4] * g[2];
    stretched[2] = tensor[5] * g[0] + tensor[4] * g[1] + tensor[2] * g[2];
}

/* Stiffness from the stretch tensor A. With h = A g: (1 - 2 shear) h_a h_b' + shear (h_b h_a' + (g_a·h_b) A).
 * (Inline, so that a tensor just computed stays in registers: 3 % of the time to fill K.) */
static inline void stretched_blocks(const OstSimd *x, const OstSimd tensor[6], double shear, OstSimd *blocks)
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    OstSimd gradient[3][3];
    OstSimd h[3][3];
    OstSimd factor;
    scaled_gradients(x, gradient, &factor);
    const OstSimd slide = shear * factor;
    const OstSimd bulk = factor - 2.0 * slide;
    for (int b = 0; b < 3; b++) {
        stretch_gradient(tensor, gradient[b], h[b]);
        const OstSimd bulk_h[3] = {bulk * h[b][0], bulk * h[b][1], bulk * h[b][2]};
        const OstSimd slide_h[3] = {slide * h[b][0], slide * h[b][1], slide * h[b][2]};
        for (int a = 0; a <= b; a++) {
            OstSimd *block = blocks + pair[a + 1][b + 1];
            const OstSimd product =
                gradient[a][0] * slide_h[0] + gradient[a][1] * slide_h[1] + gradient[a][2] * slide_h[2];
            for (int n = 0; n < 9; n++)
                block[n] = h[a][n / 3] * bulk_h[n % 3] + slide_h[n / 3] * h[a][n % 3] + product * tensor[place[n]];
        }
    }
    complete_by_translations(blocks);
}

OST_KERNEL static void tet4_stiffness(const OstSimd *x, const OstElasticity *elasticity, OstSimd *blocks)
{
    if (elasticity->about_line) {
        OstSimd tensor[6];
        ost_stretch_about_line(elasticity, x, tensor);
        stretched_blocks(x, tensor, elasticity->shear, blocks);
    } else if (elasticity->by_stretch)
        stretched_blocks(x, elasticity->stretch_tensor, elasticity->shear, blocks);
    else
        ost_tet4_blocks(x, elasticity->c[0], blocks);
}

/* Strain times the determinant d. */
static inline void scaled_strain(OstSimd gradient[3][3], const OstSimd *u, OstSimd strain[6])
{
    OstSimd slope[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[i][j] = (u[3 + i] - u[i]) * gradient[0][j] + (u[6 + i] - u[i]) * gradient[1][j] +
                          (u[9 + i] - u[i]) * gradient[2][j];
    ost_strain_of_slope(slope, strain);
}

static inline void determinant_of(const OstSimd *x, OstSimd gradient[3][3], OstSimd *determinant)
{
    *determinant = (x[3] - x[0]) * gradient[0][0] + (x[4] - x[1]) * gradient[0][1] + (x[5] - x[2]) * gradient[0][2];
}

/* `mean`: becomes the stress; or NULL. */
static inline void find_force(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force,
                              OstSimd *mean)
{
    OstSimd gradient[3][3];
    OstSimd strain[6];
    OstSimd stress[6];
    OstSimd factor, determinant;
    scaled_gradients(x, gradient, &factor);
    scaled_strain(gradient, u, strain);
    determinant_of(x, gradient, &determinant);
    for (int p = 0; p < 6 && elasticity->eigenstrained; p++)
        strain[p] -= determinant * elasticity->e0[0][p];
    ost_simd_stress(elasticity->c[0], strain, stress);
    for (int p = 0; p < 6; p++) {
        if (mean)
            mean[p] = stress[p] / determinant;
        stress[p] *= factor;
    }
    for (int a = 1; a < 4; a++)
        ost_force_of_stress(gradient[a - 1], stress, force + 3 * a);
    for (int i = 0; i < 3; i++)
        force[i] = -(force[3 + i] + force[6 + i] + force[9 + i]);
}

OST_KERNEL static void tet4_force(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force)
{
    find_force(x, elasticity, u, force, NULL);
}

OST_KERNEL static void tet4_force_and_stress(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                                             OstSimd *force, OstSimd stress[6])
{
    find_force(x, elasticity, u, force, stress);
}

OST_KERNEL static void tet4_magnitude(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                                      OstSimd *magnitude)
{
    OstSimd g[4][3];
    OstSimd strain[6] = {{0}};
    OstSimd stress[6];
    OstSimd factor;
    scaled_gradients(x, g + 1, &factor);
    for (int i = 0; i < 3; i++)
        g[0][i] = g[1][i] + g[2][i] + g[3][i];
    for (int a = 0; a < 4; a++) {
        for (int i = 0; i < 3; i++)
            ost_simd_absolute(&g[a][i]);
        ost_add_strain_size(g[a], u + 3 * a, strain);
    }
    for (int p = 0; p < 6 && elasticity->eigenstrained; p++) {
        OstSimd size = elasticity->e0[0][p] / (6.0 * factor); /* 1 / 6 factor is the determinant */
        ost_simd_absolute(&size);
        strain[p] += size;
    }
    ost_simd_stress_size(elasticity->c[0], strain, stress);
    for (int p = 0; p < 6; p++)
        stress[p] *= factor;
    for (int a = 0; a < 4; a++)
        ost_force_of_stress(g[a], stress, magnitude + 3 * a);
}

static inline void tet4_strain(const OstSimd *x, const OstSimd *u, OstSimd strain[6], OstSimd *determinant)
{
    OstSimd gradient[3][3];
    OstSimd factor;
    scaled_gradients(x, gradient, &factor);
    determinant_of(x, gradient, determinant);
    scaled_strain(gradient, u, strain);
    const OstSimd inverse = 1.0 / *determinant;
    for (int p = 0; p < 6; p++)
        strain[p] *= inverse;
}

OST_KERNEL static void tet4_means(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstMeans *means)
{
    OstSimd determinant;
    OstSimd elastic[6];
    tet4_strain(x, u, means->strain, &determinant);
    ost_simd_absolute(&determinant);
    means->volume = determinant / 6.0;
    ost_elastic_strain(elasticity, 0, means->strain, elastic);
    ost_simd_stress(elasticity->c[0], elastic, means->stress);
    means->energy = means->stiff = means->eigen = (OstSimd){0};
    for (int p = 0; p < 6; p++) {
        means->energy += 0.5 * means->stress[p] * elastic[p];
        if (elasticity->eigenstrained)
            means->eigen += means->stress[p] * elasticity->e0[0][p];
    }
}

static void tet4_nodal_strain(const OstSimd *x, const OstKeptPoints *at_nodes, const OstSimd *u, OstSimd *strain)
{
    (void)at_nodes;
    OstSimd determinant;
    tet4_strain(x, u, strain, &determinant);
    for (int n = 6; n < 24; n++)
        strain[n] = strain[n - 6];
}

static const OstQuadrature *tet4_rule(const OstSimd *x, const OstElasticity *elasticity)
{
    (void)x;
    (void)elasticity;
    return &ost_tet_degree1;
}

OST_KERNEL static void tet4_evaluate(const OstSimd *x, const OstQuadraturePoint *at, OstPoint *point)
{
    OstSimd scaled[3][3];
    OstSimd factor; /* 1 / (6 |determinant|) */
    OstSimd edge[3] = {x[3] - x[0], x[4] - x[1], x[5] - x[2]};
    scaled_gradients(x, scaled, &factor);
    const OstSimd inverse = 1.0 / (edge[0] * scaled[0][0] + edge[1] * scaled[0][1] + edge[2] * scaled[0][2]);
    for (int i = 0; i < 3; i++) {
        for (int a = 0; a < 3; a++)
            point->gradient[a + 1][i] = scaled[a][i] * inverse;
        point->gradient[0][i] = -(point->gradient[1][i] + point->gradient[2][i] + point->gradient[3][i]);
    }
    point->volume = at->weight / (36.0 * factor);
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
    .linear = 1,
    .rule = tet4_rule,
    .evaluate = tet4_evaluate,
    .stiffness = tet4_stiffness,
    .force = tet4_force,
    .force_and_stress = tet4_force_and_stress,
    .magnitude = tet4_magnitude,
    .means = tet4_means,
    .nodal_strain = tet4_nodal_strain,
    .volume = tet4_volume,
    .gradient = tet4_gradient,
    .laplacian = tet4_laplacian,
    .node_volumes = tet4_node_volumes,
    .node_areas = tet4_node_areas,
};

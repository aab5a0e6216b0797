/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_ELEMENT_SUPPORT_H
#define ORTHOSTAT_TESTS_ELEMENT_SUPPORT_H

#include "support.h"

#include "element/element.h"
#include "orthostat/axes.h"
#include "orthostat/material.h"

/* Numbers in [-1, 1), the same on every machine. */
static inline double random_number(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1.0;
}

/* Vertices of a skewed tet of no particular place; odd seeds give it the other orientation. */
static inline void random_tet(unsigned seed, double x[12])
{
    static const double regular[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    unsigned s = seed;
    for (int i = 0; i < 12; i++)
        x[i] = 5.0 + regular[i] + 0.2 * random_number(&s);
    if (seed % 2 == 1)
        for (int i = 0; i < 3; i++) {
            const double kept = x[3 + i];
            x[3 + i] = x[6 + i];
            x[6 + i] = kept;
        }
}

static inline void random_axes(unsigned seed, double axes[9])
{
    double q[4];
    for (int i = 0; i < 4; i++)
        q[i] = random_number(&seed);
    assert_success(ost_axes_from_quaternion(ctx, q, axes));
}

/* F = Q1 diag(stretch) Q2 */
static inline void deformation(unsigned seed, const double stretch[3], double f[9])
{
    double before[9], after[9];
    random_axes(seed, before);
    random_axes(seed + 50u, after);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            f[3 * i + j] = 0.0;
            for (int k = 0; k < 3; k++)
                f[3 * i + j] += after[3 * k + i] * stretch[k] * before[3 * k + j];
        }
}

static inline void orthotropic_material(OstMaterial *material)
{
    const OstOrthotropic constants = {
        .youngs_modulus = {140e3, 10e3, 9e3}, .poissons_ratio = {0.3, 0.4, 0.02}, .shear_modulus = {5e3, 3e3, 4e3}};
    assert_success(ost_material_create(ctx, "ply", &constants, 2.0, material));
}

/* The upper triangle of a 6×6 matrix, for every tet of a batch. */
static inline void fill_batch(const double c[36], OstSimd *batch)
{
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++, n++)
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                batch[n][slot] = c[6 * p + q];
}

/* One C in every tet. */
static inline void uniform_elasticity(const double c[36], OstElasticity *elasticity)
{
    ost_elasticity_clear(elasticity);
    elasticity->points = 1;
    elasticity->by_mean = 0;
    elasticity->region = 0;
    fill_batch(c, elasticity->c[0]);
}

/* C of the ply in random axes. */
static inline void turned_ply(double c[36])
{
    OstMaterial material;
    double axes[9];
    orthotropic_material(&material);
    random_axes(11u, axes);
    ost_material_rotate_stiffness(material.stiffness, axes, c);
}

/* Adds weight × B'CB for shape functions with these gradients, B written out from the definition of strain. */
static inline void add_plain_product(int nodes, const double *g, const double c[36], double weight, double *k)
{
    const int width = 3 * nodes;
    double *b = calloc((size_t)(6 * width), sizeof *b);
    for (int a = 0; a < nodes; a++) {
        const double dx = g[3 * a], dy = g[3 * a + 1], dz = g[3 * a + 2];
        b[0 * width + 3 * a] = dx;
        b[1 * width + 3 * a + 1] = dy;
        b[2 * width + 3 * a + 2] = dz;
        b[3 * width + 3 * a] = dy;
        b[3 * width + 3 * a + 1] = dx;
        b[4 * width + 3 * a + 1] = dz;
        b[4 * width + 3 * a + 2] = dy;
        b[5 * width + 3 * a] = dz;
        b[5 * width + 3 * a + 2] = dx;
    }
    for (int i = 0; i < width; i++)
        for (int j = 0; j < width; j++)
            for (int pq = 0; pq < 36; pq++)
                k[width * i + j] += weight * b[pq / 6 * width + i] * c[pq] * b[pq % 6 * width + j];
    free(b);
}

/* One tet's blocks as a full matrix. */
static inline void full_matrix(int nodes, const OstSimd *blocks, int slot, double *k)
{
    const int width = 3 * nodes;
    for (int a = 0; a < nodes; a++)
        for (int b = a; b < nodes; b++)
            for (int n = 0; n < 9; n++) {
                const double value = blocks[9 * ost_pair_index(nodes, a, b) + n][slot];
                k[width * (3 * a + n / 3) + 3 * b + n % 3] = value;
                k[width * (3 * b + n % 3) + 3 * a + n / 3] = value;
            }
}

static inline double largest_of(int count, const double *k)
{
    double size = 0.0;
    for (int i = 0; i < count; i++)
        size = fmax(size, fabs(k[i]));
    return size;
}

#endif

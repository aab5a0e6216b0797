/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/exact_tet.h"

#include "element/quadrature.h"
#include "element/tets.h"

#include <string.h>

enum { MOST = OST_MAX_TET_NODES };

/* A quadrature point: gradients of the shape functions, and its part of the volume. */
typedef struct Point {
    Long gradient[MOST][3];
    Long volume;
} Point;

static const OstQuadraturePoint middle = {{0.25, 0.25, 0.25, 0.25}, 1.0};
static const OstQuadrature one_point = {1, &middle};

/* dN/dL_c of the shape functions, for barycentric coordinates L. */
static void derive_shapes(int nodes, const double at[4], Long slope[MOST][4])
{
    memset(slope, 0, MOST * sizeof *slope);
    for (int a = 0; a < nodes; a++) {
        const int *end = ost_tet10_ends[a];
        if (nodes == 4)
            slope[a][a] = 1.0L;
        else if (a < 4)
            slope[a][a] = 4.0L * (Long)at[a] - 1.0L;
        else {
            slope[a][end[0]] = 4.0L * (Long)at[end[1]];
            slope[a][end[1]] = 4.0L * (Long)at[end[0]];
        }
    }
}

static void cross(const Long a[3], const Long b[3], Long product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void evaluate(const OstBatch *batch, int slot, int nodes, const OstQuadraturePoint *at, Point *point)
{
    Long slope[MOST][4], edge[3][3] = {{0}}, gradient[4][3], determinant = 0.0L;
    derive_shapes(nodes, at->at, slope);
    for (int a = 1; a < nodes; a++)
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < 3; i++)
                edge[c][i] +=
                    (slope[a][c + 1] - slope[a][0]) * ((Long)batch->x[3 * a + i][slot] - (Long)batch->x[i][slot]);
    for (int c = 0; c < 3; c++)
        cross(edge[(c + 1) % 3], edge[(c + 2) % 3], gradient[c + 1]);
    for (int i = 0; i < 3; i++)
        determinant += edge[0][i] * gradient[1][i];
    for (int i = 0; i < 3; i++) {
        for (int c = 1; c < 4; c++)
            gradient[c][i] /= determinant;
        gradient[0][i] = -(gradient[1][i] + gradient[2][i] + gradient[3][i]);
    }
    point->volume = (determinant < 0.0L ? -determinant : determinant) / 6.0L * (Long)at->weight;
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < 3; i++) {
            point->gradient[a][i] = 0.0L;
            for (int c = 0; c < 4; c++)
                point->gradient[a][i] += slope[a][c] * gradient[c][i];
        }
}

static void strain_of(const Point *point, int nodes, const Long *u, Long strain[6])
{
    Long slope[3][3] = {{0}};
    for (int a = 1; a < nodes; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                slope[i][j] += u[3 * a + i] * point->gradient[a][j];
    for (int i = 0; i < 3; i++) {
        strain[i] = slope[i][i];
        strain[3 + i] = slope[i][(i + 1) % 3] + slope[(i + 1) % 3][i];
    }
}

static void stress_of(const OstElasticity *elasticity, int at, int slot, const Long strain[6], Long stress[6])
{
    memset(stress, 0, 6 * sizeof *stress);
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++, n++) {
            const Long c = elasticity->c[at][n][slot];
            stress[p] += c * strain[q];
            if (q > p)
                stress[q] += c * strain[p];
        }
}

static void add_force(const Point *point, int nodes, const Long stress[6], Long *force)
{
    for (int a = 0; a < nodes && force; a++)
        for (int i = 0; i < 3; i++) {
            const int before = (i + 2) % 3; /* shears are 12 23 31 */
            force[3 * a + i] +=
                point->volume * (stress[i] * point->gradient[a][i] + stress[3 + i] * point->gradient[a][(i + 1) % 3] +
                                 stress[3 + before] * point->gradient[a][before]);
        }
}

/* Mean over the tet of m'strain, where C is split. */
static Long mean_of_mode(const OstBatch *batch, int slot, int nodes, const OstQuadrature *rule, const Long *u)
{
    Long sum = 0.0L, volume = 0.0L;
    for (int q = 0; q < rule->count; q++) {
        Point point;
        Long strain[6];
        evaluate(batch, slot, nodes, &rule->point[q], &point);
        strain_of(&point, nodes, u, strain);
        volume += point.volume;
        for (int p = 0; p < 6; p++)
            sum +=
                point.volume * (Long)batch->elasticity.m[ost_elasticity_at(&batch->elasticity, q)][p][slot] * strain[p];
    }
    return sum / volume;
}

/* Adds m p to the stress, and a point's part of each vertex's share of m'strain - looseness p. */
static void add_mixed(const OstBatch *batch, int slot, const OstQuadraturePoint *place, int at, const Point *point,
                      const Long strain[6], const Long pressure[4], Long stress[6], Long *volume)
{
    Long mode = 0.0L, p = 0.0L;
    for (int v = 0; v < 4; v++)
        p += pressure[v] * (Long)place->at[v];
    for (int s = 0; s < 6; s++) {
        const Long m = batch->elasticity.m[at][s][slot];
        stress[s] += p * m;
        mode += m * strain[s];
    }
    for (int v = 0; v < 4 && volume; v++)
        volume[v] += point->volume * (Long)place->at[v] * (mode - (Long)batch->elasticity.looseness[slot] * p);
}

void hard_exact_tet(const OstBatch *batch, int slot, int nodes, const Long *u, const Long pressure[4], Long *force,
                    Long mean[6], Long volume_left[4])
{
    const OstElasticity *elasticity = &batch->elasticity;
    const int by_mean = nodes > 4 && elasticity->by_mean;
    const OstQuadrature *rule = nodes == 4 ? &one_point : &ost_tet_degree3;
    const Long stiff = by_mean ? mean_of_mode(batch, slot, nodes, rule, u) : 0.0L;
    Long volume = 0.0L, sum[6] = {0};
    if (force)
        memset(force, 0, 3 * (size_t)nodes * sizeof *force);
    if (volume_left)
        memset(volume_left, 0, 4 * sizeof *volume_left);
    for (int q = 0; q < rule->count; q++) {
        const int at = nodes == 4 ? 0 : ost_elasticity_at(elasticity, q);
        Point point;
        Long strain[6], stress[6];
        evaluate(batch, slot, nodes, &rule->point[q], &point);
        strain_of(&point, nodes, u, strain);
        stress_of(elasticity, at, slot, strain, stress);
        if (pressure && elasticity->mixed)
            add_mixed(batch, slot, &rule->point[q], at, &point, strain, pressure, stress, volume_left);
        for (int p = 0; p < 6; p++) {
            stress[p] += by_mean ? stiff * (Long)elasticity->m[at][p][slot] : 0.0L;
            sum[p] += point.volume * stress[p];
        }
        volume += point.volume;
        add_force(&point, nodes, stress, force);
    }
    for (int p = 0; p < 6 && mean; p++)
        mean[p] = sum[p] / volume;
}

const double hard_least_reaction = 1e-3;

Long hard_spring_force(const OstSupports *supports, size_t node, size_t i, const Twofold *u)
{
    const double *spring = supports->spring;
    Long sum = 0.0L;
    for (size_t j = 0; j < 3 && spring; j++)
        sum += (Long)spring[9 * node + 3 * i + j] * ((Long)u[3 * node + j].high + (Long)u[3 * node + j].low);
    return sum;
}

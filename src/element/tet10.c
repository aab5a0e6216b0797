/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/tets.h"

#include "core/kernel.h"
#include "core/small.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"

#include <string.h>

enum { NODES = 10, NUMBERS = 3 * NODES, PAIRS = NODES * (NODES + 1) / 2, POINTS = 8 };

const int ost_tet10_ends[NODES][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/* The mid-edge node between vertices a and b; for a = b the vertex. */
static const int node_between[4][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}};

/* An edge counts as straight if its node is this near to its middle, relative to its length. */
static const double straight = 1e-12;

/* Gradients of the barycentric coordinates, and the determinant of the map. dx/dL_c is the sum over nodes of x times
 * the shape function's derivative: 4 L_c - 1 for vertex c, 4 L_b for the node between c and b. */
static inline void coordinate_gradients(const OstSimd *x, const double at[4], OstSimd gradient[4][3],
                                        OstSimd *determinant)
{
    OstSimd slope[4][3];
    for (int c = 0; c < 4; c++)
        for (int i = 0; i < 3; i++) {
            slope[c][i] = (4.0 * at[c] - 1.0) * x[3 * c + i];
            for (int b = 0; b < 4; b++)
                if (b != c)
                    slope[c][i] += 4.0 * at[b] * x[3 * node_between[c][b] + i];
        }
    for (int c = 1; c < 4; c++)
        for (int i = 0; i < 3; i++)
            slope[c][i] -= slope[0][i];
    ost_simd_cross(slope[2], slope[3], gradient[1]);
    ost_simd_cross(slope[3], slope[1], gradient[2]);
    ost_simd_cross(slope[1], slope[2], gradient[3]);
    *determinant = slope[1][0] * gradient[1][0] + slope[1][1] * gradient[1][1] + slope[1][2] * gradient[1][2];
    const OstSimd inverse = 1.0 / *determinant;
    for (int i = 0; i < 3; i++) {
        for (int c = 1; c < 4; c++)
            gradient[c][i] *= inverse;
        gradient[0][i] = -(gradient[1][i] + gradient[2][i] + gradient[3][i]);
    }
}

/* With the volume signed, and without a weight. */
static inline void evaluate(const OstSimd *x, const double at[4], OstPoint *point)
{
    OstSimd of_coordinate[4][3];
    coordinate_gradients(x, at, of_coordinate, &point->volume);
    point->volume /= 6.0;
    for (int i = 0; i < 3; i++) {
        for (int a = 0; a < 4; a++)
            point->gradient[a][i] = (4.0 * at[a] - 1.0) * of_coordinate[a][i];
        for (int a = 4; a < NODES; a++) {
            const int *end = ost_tet10_ends[a];
            point->gradient[a][i] =
                4.0 * (at[end[0]] * of_coordinate[end[1]][i] + at[end[1]] * of_coordinate[end[0]][i]);
        }
    }
}

/* Straight edges and a uniform C make the integrand of the stiffness quadratic. */
static inline unsigned find_uniform(const OstSimd *x, const OstElasticity *elasticity)
{
    unsigned uniform = ~elasticity->varying & ((1U << OST_SIMD_WIDTH) - 1U);
    for (int a = 4; a < NODES; a++) {
        const int *end = ost_tet10_ends[a];
        OstSimd off = {0};
        OstSimd length = {0};
        for (int i = 0; i < 3; i++) {
            const OstSimd from = x[3 * end[0] + i];
            const OstSimd to = x[3 * end[1] + i];
            const OstSimd bend = x[3 * a + i] - 0.5 * (from + to);
            off += bend * bend;
            length += (to - from) * (to - from);
        }
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            if (!(off[slot] <= straight * straight * length[slot]))
                uniform &= ~(1U << slot);
    }
    return uniform;
}

static inline int is_uniform(const OstSimd *x, const OstElasticity *elasticity)
{
    return elasticity->points == 1 && find_uniform(x, elasticity) == (1U << OST_SIMD_WIDTH) - 1U;
}

/* Degree 2 integrates uniform tets without error. For the others it would be enough for convergence of order 2
 * (Ciarlet, The Finite Element Method for Elliptic Problems, 4.1 and 4.4), but degree 3 also gives curved tets their
 * true volume and the patch test, since the map's cofactors have degree 2 and its determinant degree 3. A higher degree
 * gains nothing: on Lekhnitskii's tube (cylindrical axes, E_t = 10 E_r) the discretisation errors with 8 and with 14
 * points agree to 3 %, those with 4 to 15 %. */
static inline const OstQuadrature *rule_for(const OstSimd *x, const OstElasticity *elasticity)
{
    if (elasticity->kept)
        return elasticity->kept->rule;
    return is_uniform(x, elasticity) ? &ost_tet_degree2 : &ost_tet_degree3;
}

/* As evaluate, with the volume positive whatever the tet's orientation, and multiplied by the weight. */
static inline void evaluate_weighted(const OstSimd *x, const OstQuadraturePoint *at, OstPoint *point)
{
    evaluate(x, at->at, point);
    ost_simd_absolute(&point->volume);
    point->volume *= at->weight;
}

/* Point q of the rule: the one that is kept, or evaluated into `room`. */
static inline const OstPoint *point_of(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule,
                                       int q, OstPoint *room)
{
    if (elasticity->kept)
        return &elasticity->kept->at[q];
    evaluate_weighted(x, &rule->point[q], room);
    return room;
}

OST_KERNEL static void tet10_evaluate(const OstSimd *x, const OstQuadraturePoint *at, OstPoint *point)
{
    evaluate_weighted(x, at, point);
}

OST_KERNEL static void tet10_keep(const OstSimd *x, const OstElasticity *elasticity, OstKeptPoints *kept)
{
    kept->rule = rule_for(x, elasticity);
    for (int q = 0; q < kept->rule->count; q++)
        evaluate_weighted(x, &kept->rule->point[q], &kept->at[q]);
}

static void tet10_places(const OstSimd *x, OstSimd *places)
{
    for (int q = 0; q < ost_tet_degree3.count; q++) {
        double shape[NODES];
        ost_shape_values(NODES, ost_tet_degree3.point[q].at, shape);
        for (int i = 0; i < 3; i++) {
            places[3 * q + i] = shape[0] * x[i];
            for (int a = 1; a < NODES; a++)
                places[3 * q + i] += shape[a] * x[3 * a + i];
        }
    }
}

/* The row m'B and m'e0, integrated over the tet, and the tet's volume. */
typedef struct MeanMode {
    OstSimd columns[NUMBERS];
    OstSimd eigen;
    OstSimd volume;
} MeanMode;

static inline void integrate_mode(const OstSimd *x, const OstElasticity *elasticity, MeanMode *mode)
{
    const OstQuadrature *rule = rule_for(x, elasticity);
    memset(mode, 0, sizeof *mode);
    for (int q = 0; q < rule->count; q++) {
        const int at = ost_elasticity_at(elasticity, q);
        OstPoint room;
        const OstPoint *point = point_of(x, elasticity, rule, q, &room);
        mode->volume += point->volume;
        for (int p = 0; p < 6 && elasticity->eigenstrained; p++)
            mode->eigen += point->volume * elasticity->m[at][p] * elasticity->e0[at][p];
        for (int a = 0; a < NODES; a++) {
            OstSimd of_node[3];
            ost_force_of_stress(point->gradient[a], elasticity->m[at], of_node);
            for (int i = 0; i < 3; i++)
                mode->columns[3 * a + i] += point->volume * of_node[i];
        }
    }
}

/* The stiff mode's energy is 1/2 volume (mean of m'strain)^2. */
static void add_mean_blocks(const OstSimd *x, const OstElasticity *elasticity, OstSimd *blocks)
{
    MeanMode mode;
    integrate_mode(x, elasticity, &mode);
    for (int a = 0; a < NODES; a++)
        for (int b = a; b < NODES; b++, blocks += 9)
            for (int n = 0; n < 9; n++)
                blocks[n] += mode.columns[3 * a + n / 3] * mode.columns[3 * b + n % 3] / mode.volume;
}

static void tet10_coupling(const OstSimd *x, const OstElasticity *elasticity, OstSimd *columns, OstSimd *eigen,
                           OstSimd *mass)
{
    const OstQuadrature *rule = rule_for(x, elasticity);
    memset(columns, 0, 4 * NUMBERS * sizeof *columns);
    memset(eigen, 0, 4 * sizeof *eigen);
    memset(mass, 0, 10 * sizeof *mass);
    for (int q = 0; q < rule->count; q++) {
        const double *share = rule->point[q].at;
        const int at = ost_elasticity_at(elasticity, q);
        OstPoint point;
        OstSimd of_eigenstrain = {0};
        evaluate_weighted(x, &rule->point[q], &point);
        for (int p = 0; p < 6 && elasticity->eigenstrained; p++)
            of_eigenstrain += point.volume * elasticity->m[at][p] * elasticity->e0[at][p];
        for (int a = 0; a < NODES; a++) {
            OstSimd of_node[3];
            ost_force_of_stress(point.gradient[a], elasticity->m[at], of_node);
            for (int i = 0; i < 3; i++) {
                of_node[i] *= point.volume;
                for (int v = 0; v < 4; v++)
                    columns[NUMBERS * v + 3 * a + i] += share[v] * of_node[i];
            }
        }
        for (int v = 0, n = 0; v < 4; v++) {
            eigen[v] += share[v] * of_eigenstrain;
            for (int w = v; w < 4; w++)
                mass[n++] += (share[v] * share[w]) * point.volume;
        }
    }
}

static inline void sum_blocks(const OstSimd *x, const OstElasticity *elasticity, OstSimd *blocks)
{
    memset(blocks, 0, 9 * PAIRS * sizeof *blocks);
    for (int q = 0; q < ost_tet_degree3.count; q++) {
        const OstSimd *c = elasticity->c[ost_elasticity_at(elasticity, q)];
        OstPoint point;
        evaluate_weighted(x, &ost_tet_degree3.point[q], &point);
        for (int b = 0; b < NODES; b++) {
            const OstSimd *g = point.gradient[b];
            const OstSimd scaled[3] = {point.volume * g[0], point.volume * g[1], point.volume * g[2]};
            OstSimd stress[6][3];
            ost_stress_columns(c, scaled, stress);
            for (int a = 0; a <= b; a++) {
                OstSimd block[9];
                OstSimd *sum = blocks + 9 * ost_pair_index(NODES, a, b);
                ost_block_of_stress(point.gradient[a], stress, block);
                for (int n = 0; n < 9; n++)
                    sum[n] += block[n];
            }
        }
    }
}

OST_KERNEL static void tet10_stiffness(const OstSimd *x, const OstElasticity *elasticity, OstSimd *blocks)
{
    if (is_uniform(x, elasticity))
        ost_tet10_straight_blocks(x, elasticity->c[0], blocks);
    else
        sum_blocks(x, elasticity, blocks);
    if (elasticity->by_mean)
        add_mean_blocks(x, elasticity, blocks);
}

/* From differences of displacements, which rounding harms far less than displacements where the body moves far. */
static inline void strain_at(const OstPoint *point, const OstSimd *u, OstSimd strain[6])
{
    OstSimd slope[3][3] = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int a = 1; a < NODES; a++) {
            const OstSimd difference = u[3 * a + i] - u[i];
            for (int j = 0; j < 3; j++)
                slope[i][j] += difference * point->gradient[a][j];
        }
    ost_strain_of_slope(slope, strain);
}

/* stress += m p, of a mixed form, at a point of the rule. */
static inline void add_pressure(const OstElasticity *elasticity, int at, const OstSimd *pressure, OstSimd stress[6])
{
    for (int p = 0; p < 6; p++)
        stress[p] += elasticity->m[at][p] * *pressure;
}

/* force += B' stress */
static inline void add_force(const OstPoint *point, const OstSimd stress[6], OstSimd *force)
{
    for (int a = 0; a < NODES; a++) {
        OstSimd of_node[3];
        ost_force_of_stress(point->gradient[a], stress, of_node);
        for (int i = 0; i < 3; i++)
            force[3 * a + i] += of_node[i];
    }
}

/* Mean of m'(strain - e0) over the tet. */
static inline void mean_of_mode(const MeanMode *mode, const OstSimd *u, OstSimd *mean)
{
    *mean = -mode->eigen;
    for (int n = 3; n < NUMBERS; n++)
        *mean += mode->columns[n] * (u[n] - u[n % 3]);
    *mean /= mode->volume;
}

/* B'C (B u - e0) with the softer C where it is split, and the mean of its stress; `mean` may be NULL. */
static inline void sum_forces(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force,
                              OstSimd *mean)
{
    const OstQuadrature *rule = rule_for(x, elasticity);
    OstSimd sum[6] = {{0}}, volume = {0};
    memset(force, 0, NUMBERS * sizeof *force);
    for (int q = 0; q < rule->count; q++) {
        OstPoint room;
        const OstPoint *point = point_of(x, elasticity, rule, q, &room);
        OstSimd strain[6];
        OstSimd elastic[6];
        OstSimd stress[6];
        const int at = ost_elasticity_at(elasticity, q);
        strain_at(point, u, strain);
        ost_elastic_strain(elasticity, at, strain, elastic);
        ost_simd_stress(elasticity->c[at], elastic, stress);
        if (elasticity->mixed) {
            OstSimd pressure;
            ost_pressure_at(elasticity, rule->point[q].at, &pressure);
            add_pressure(elasticity, at, &pressure, stress);
        }
        volume += point->volume;
        for (int p = 0; p < 6; p++) {
            stress[p] *= point->volume;
            sum[p] += stress[p];
        }
        add_force(point, stress, force);
    }
    for (int p = 0; p < 6 && mean; p++)
        mean[p] = sum[p] / volume;
}

OST_KERNEL static void tet10_force(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force)
{
    MeanMode mode;
    OstSimd mean;
    if (rule_for(x, elasticity) == &ost_tet_degree2 && !elasticity->mixed)
        ost_tet10_straight_force(x, elasticity, u, force);
    else
        sum_forces(x, elasticity, u, force, NULL);
    if (!elasticity->by_mean)
        return;
    integrate_mode(x, elasticity, &mode);
    mean_of_mode(&mode, u, &mean);
    for (int n = 0; n < NUMBERS; n++)
        force[n] += mean * mode.columns[n];
}

/* |C|; if C is split, |c| + |m m'|. */
static inline void absolute_elasticity(const OstElasticity *elasticity, int at, OstSimd c[OST_ELASTICITY_COUNT])
{
    memcpy(c, elasticity->c[at], sizeof elasticity->c[at]);
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++, n++) {
            OstSimd product = {0};
            if (elasticity->by_mean)
                product = elasticity->m[at][p] * elasticity->m[at][q];
            ost_simd_absolute(&c[n]);
            ost_simd_absolute(&product);
            c[n] += product;
        }
}

OST_KERNEL static void tet10_magnitude(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                                       OstSimd *magnitude)
{
    const OstQuadrature *rule = rule_for(x, elasticity);
    memset(magnitude, 0, NUMBERS * sizeof *magnitude);
    for (int q = 0; q < rule->count; q++) {
        OstPoint point;
        OstSimd c[OST_ELASTICITY_COUNT];
        OstSimd strain[6] = {{0}};
        OstSimd stress[6];
        point = *point_of(x, elasticity, rule, q, &point);
        for (int a = 0; a < NODES; a++) {
            for (int i = 0; i < 3; i++)
                ost_simd_absolute(&point.gradient[a][i]);
            ost_add_strain_size(point.gradient[a], u + 3 * a, strain);
        }
        const int at = ost_elasticity_at(elasticity, q);
        for (int p = 0; p < 6 && elasticity->eigenstrained; p++) {
            OstSimd size = elasticity->e0[at][p];
            ost_simd_absolute(&size);
            strain[p] += size;
        }
        absolute_elasticity(elasticity, at, c);
        ost_simd_stress_size(c, strain, stress);
        for (int p = 0; p < 6 && elasticity->mixed; p++) {
            OstSimd size;
            ost_pressure_at(elasticity, rule->point[q].at, &size);
            size *= elasticity->m[at][p];
            ost_simd_absolute(&size);
            stress[p] += size;
        }
        for (int p = 0; p < 6; p++)
            stress[p] *= point.volume;
        add_force(&point, stress, magnitude);
    }
}

/* Adds a point to the integrals of strain, stress and energy; the stiff mode's energy comes once for the tet. */
static inline void add_means(const OstPoint *point, const OstElasticity *elasticity, int at, const OstSimd *pressure,
                             const OstSimd strain[6], OstMeans *sums)
{
    OstSimd elastic[6];
    OstSimd stress[6];
    ost_elastic_strain(elasticity, at, strain, elastic);
    ost_simd_stress(elasticity->c[at], elastic, stress);
    if (elasticity->mixed)
        sums->energy += 0.5 * point->volume * elasticity->looseness * *pressure * *pressure;
    for (int p = 0; p < 6; p++) {
        sums->strain[p] += point->volume * strain[p];
        sums->energy += 0.5 * point->volume * elastic[p] * stress[p];
        if (elasticity->by_mean)
            stress[p] += sums->stiff * elasticity->m[at][p];
        if (elasticity->mixed)
            stress[p] += *pressure * elasticity->m[at][p];
        sums->stress[p] += point->volume * stress[p];
        if (elasticity->eigenstrained)
            sums->eigen += point->volume * elasticity->e0[at][p] * stress[p];
    }
}

static inline void sum_means(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstMeans *means)
{
    const OstQuadrature *rule = rule_for(x, elasticity);
    OstSimd volume = {0};
    for (int q = 0; q < rule->count; q++) {
        OstPoint room;
        const OstPoint *point = point_of(x, elasticity, rule, q, &room);
        OstSimd strain[6];
        strain_at(point, u, strain);
        volume += point->volume;
        OstSimd pressure = {0};
        if (elasticity->mixed)
            ost_pressure_at(elasticity, rule->point[q].at, &pressure);
        add_means(point, elasticity, ost_elasticity_at(elasticity, q), &pressure, strain, means);
    }
    for (int p = 0; p < 6; p++) {
        means->strain[p] /= volume;
        means->stress[p] /= volume;
    }
    means->energy = means->energy / volume + 0.5 * means->stiff * means->stiff;
    means->eigen /= volume;
    means->volume = volume;
}

OST_KERNEL static void tet10_means(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstMeans *means)
{
    memset(means, 0, sizeof *means);
    if (elasticity->by_mean) {
        MeanMode mode;
        integrate_mode(x, elasticity, &mode);
        mean_of_mode(&mode, u, &means->stiff);
    }
    if (rule_for(x, elasticity) == &ost_tet_degree2 && !elasticity->mixed)
        ost_tet10_straight_means(x, elasticity, u, means);
    else
        sum_means(x, elasticity, u, means);
}

OST_KERNEL static void tet10_force_and_stress(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                                              OstSimd *force, OstSimd stress[6])
{
    OstMeans means;
    if (!elasticity->by_mean && rule_for(x, elasticity) != &ost_tet_degree2) {
        sum_forces(x, elasticity, u, force, stress);
        return;
    }
    tet10_force(x, elasticity, u, force);
    tet10_means(x, elasticity, u, &means);
    memcpy(stress, means.stress, sizeof means.stress);
}

OST_KERNEL static void tet10_keep_nodes(const OstSimd *x, OstKeptPoints *at_nodes)
{
    for (int a = 0; a < NODES; a++) {
        double at[4] = {0.0};
        at[ost_tet10_ends[a][0]] += 0.5;
        at[ost_tet10_ends[a][1]] += 0.5;
        evaluate(x, at, &at_nodes->at[a]);
    }
}

OST_KERNEL static void tet10_nodal_strain(const OstSimd *x, const OstKeptPoints *at_nodes, const OstSimd *u,
                                          OstSimd *strain)
{
    (void)x;
    for (int a = 0; a < NODES; a++)
        strain_at(&at_nodes->at[a], u, strain + 6 * a);
}

/* The functions below are for one tet: they compute a batch of copies of it and read the first. */
static void copy_to_batch(int count, const double *numbers, OstSimd *batch)
{
    for (int n = 0; n < count; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            batch[n][slot] = numbers[n];
}

static double tet10_volume(const double *x)
{
    OstSimd batch[NUMBERS];
    double volume = 0.0;
    copy_to_batch(NUMBERS, x, batch);
    for (int q = 0; q < ost_tet_degree3.count; q++) {
        OstPoint point;
        evaluate(batch, ost_tet_degree3.point[q].at, &point);
        volume += ost_tet_degree3.point[q].weight * point.volume[0];
    }
    return volume;
}

static void tet10_gradient(const double *x, const double *u, double gradient[9])
{
    OstSimd batch[NUMBERS];
    double volume = 0.0;
    copy_to_batch(NUMBERS, x, batch);
    memset(gradient, 0, 9 * sizeof *gradient);
    for (int q = 0; q < ost_tet_degree3.count; q++) {
        OstPoint point;
        evaluate_weighted(batch, &ost_tet_degree3.point[q], &point);
        volume += point.volume[0];
        for (int n = 0; n < 9; n++)
            for (int a = 0; a < NODES; a++)
                gradient[n] += point.volume[0] * u[3 * a + n / 3] * point.gradient[a][n % 3][0];
    }
    for (int n = 0; n < 9; n++)
        gradient[n] /= volume;
}

static void tet10_laplacian(const double *x, double *pairs)
{
    OstSimd batch[NUMBERS];
    copy_to_batch(NUMBERS, x, batch);
    memset(pairs, 0, PAIRS * sizeof *pairs);
    for (int q = 0; q < ost_tet_degree3.count; q++) {
        OstPoint point;
        evaluate_weighted(batch, &ost_tet_degree3.point[q], &point);
        for (int a = 0, n = 0; a < NODES; a++)
            for (int b = a; b < NODES; b++, n++)
                for (int i = 0; i < 3; i++)
                    pairs[n] += point.volume[0] * point.gradient[a][i][0] * point.gradient[b][i][0];
    }
}

/* The map's determinant has degree 3, the shape functions 2. */
static void tet10_node_volumes(const double *x, double *volumes)
{
    OstSimd batch[NUMBERS];
    copy_to_batch(NUMBERS, x, batch);
    memset(volumes, 0, NODES * sizeof *volumes);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        double shape[NODES];
        OstPoint point;
        evaluate_weighted(batch, &ost_tet_degree5.point[q], &point);
        ost_shape_values(NODES, ost_tet_degree5.point[q].at, shape);
        for (int a = 0; a < NODES; a++)
            volumes[a] += point.volume[0] * shape[a];
    }
}

/* The area vector has degree 2, as have the shape functions. */
static void tet10_node_areas(const double *x, double *areas, double *area_vectors)
{
    memset(areas, 0, 6 * sizeof *areas);
    memset(area_vectors, 0, 18 * sizeof *area_vectors);
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
        double shape[6];
        double vector[3];
        ost_shape_values(6, point->at, shape);
        ost_shape_area_vector(6, point->at, x, vector);
        for (int a = 0; a < 6; a++) {
            const double share = 0.5 * point->weight * shape[a];
            areas[a] += share * ost_norm3(vector);
            for (int i = 0; i < 3; i++)
                area_vectors[3 * a + i] += share * vector[i];
        }
    }
}

const OstElement ost_tet10 = {
    .nodes = NODES,
    .nodes_per_face = 6,
    .linear = 1,
    .points = POINTS,
    .at = &ost_tet_degree3,
    .places = tet10_places,
    .rule = rule_for,
    .uniform = find_uniform,
    .evaluate = tet10_evaluate,
    .keep = tet10_keep,
    .stiffness = tet10_stiffness,
    .coupling = tet10_coupling,
    .force = tet10_force,
    .force_and_stress = tet10_force_and_stress,
    .magnitude = tet10_magnitude,
    .means = tet10_means,
    .nodal_strain = tet10_nodal_strain,
    .keep_nodes = tet10_keep_nodes,
    .volume = tet10_volume,
    .gradient = tet10_gradient,
    .laplacian = tet10_laplacian,
    .node_volumes = tet10_node_volumes,
    .node_areas = tet10_node_areas,
};

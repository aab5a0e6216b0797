/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/biot.h"
#include "element/large_rotation.h"
#include "element/strain_batch.h"
#include "element/tets.h"

#include <math.h>
#include <string.h>

/* Where a tet is crushed flat, its stress is that of this share of its volume. */
static const double least_volume = 1e-6;

/* A batch of tets at a displacement u. */
typedef struct Tets {
    const OstElement *element;
    OstFormulation formulation;
    const OstSimd *x, *u;
    OstMeans means;
    OstSimd rotation[9]; /* classical: that of the mean F, and the displacement that is left */
    OstSimd d[3 * OST_MAX_TET_NODES];
} Tets;

static void prepare(Tets *tets, const OstElasticity *elasticity)
{
    ost_large_rotation_means(tets->element, tets->formulation, tets->x, elasticity, tets->u, &tets->means);
    if (tets->formulation == OST_FORMULATION_CLASSICAL)
        ost_classical_displacement(tets->element, tets->x, elasticity, tets->u, tets->rotation, tets->d);
}

/* C : (strain - e0), with the stiff mode's part. */
static void stress_of(const Tets *tets, const OstElasticity *elasticity, int place, const double at[4],
                      const OstSimd strain[6], OstSimd stress[6])
{
    OstSimd elastic[6];
    ost_elastic_strain(elasticity, place, strain, elastic);
    ost_simd_stress(elasticity->c[place], elastic, stress);
    for (int p = 0; p < 6 && elasticity->by_mean; p++)
        stress[p] += tets->means.stiff * elasticity->m[place][p];
    if (elasticity->mixed) {
        OstSimd pressure;
        ost_pressure_at(elasticity, at, &pressure);
        for (int p = 0; p < 6; p++)
            stress[p] += pressure * elasticity->m[place][p];
    }
}

static void consistent_piola(const Tets *tets, const OstElasticity *elasticity, int place, const double at[4],
                             const OstPolar *polar, OstSimd piola[9])
{
    OstSimd strain[6], stress[6];
    ost_biot_strain(polar, strain);
    stress_of(tets, elasticity, place, at, strain, stress);
    ost_biot_piola(polar, stress, piola);
}

static void classical_piola(const Tets *tets, const OstElasticity *elasticity, int place, const double at[4],
                            const OstPoint *point, OstSimd piola[9])
{
    OstSimd slope[9], strain[6], stress[6];
    ost_displacement_gradient(tets->element->nodes, point, tets->d, slope);
    for (int p = 0; p < 6; p++) {
        const int i = p % 3;
        const int j = (i + 1) % 3;
        strain[p] = p < 3 ? slope[4 * i] : slope[3 * i + j] + slope[3 * j + i];
    }
    stress_of(tets, elasticity, place, at, strain, stress);
    const OstSimd *const row[3][3] = {{&stress[0], &stress[3], &stress[5]},
                                      {&stress[3], &stress[1], &stress[4]},
                                      {&stress[5], &stress[4], &stress[2]}};
    for (int n = 0; n < 9; n++)
        piola[n] = tets->rotation[n / 3 * 3] * *row[0][n % 3] + tets->rotation[n / 3 * 3 + 1] * *row[1][n % 3] +
                   tets->rotation[n / 3 * 3 + 2] * *row[2][n % 3];
}

void ost_kirchhoff_of_piola(const OstSimd piola[9], const OstSimd slope[9], OstSimd tau[6])
{
    for (int p = 0; p < 6; p++) {
        const int i = p % 3;
        const int j = p < 3 ? p : (p + 1) % 3;
        tau[p] = 0.5 * (piola[3 * i + j] + piola[3 * j + i]);
        for (int k = 0; k < 3; k++)
            tau[p] += 0.5 * (piola[3 * i + k] * slope[3 * j + k] + piola[3 * j + k] * slope[3 * i + k]);
    }
}

void ost_divide_by_volume(const OstSimd *jacobian, OstSimd stress[6])
{
    OstSimd volume;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        volume[slot] = copysign(fmax(fabs((*jacobian)[slot]), least_volume), (*jacobian)[slot]);
    for (int p = 0; p < 6; p++)
        stress[p] /= volume;
}

/* One point: the symmetric part of Kirchhoff's stress P F' (all of it, but for the classical form), and det F. */
static void kirchhoff(const Tets *tets, const OstElasticity *elasticity, int place, const double at[4],
                      const OstPoint *point, OstSimd tau[6], OstSimd *jacobian)
{
    OstSimd slope[9], piola[9];
    OstPolar polar;
    ost_displacement_gradient(tets->element->nodes, point, tets->u, slope);
    ost_polar(slope, &polar);
    if (tets->formulation == OST_FORMULATION_CLASSICAL)
        classical_piola(tets, elasticity, place, at, point, piola);
    else
        consistent_piola(tets, elasticity, place, at, &polar, piola);
    ost_kirchhoff_of_piola(piola, slope, tau);
    *jacobian = polar.stretch[0] * polar.stretch[1] * polar.stretch[2];
}

void ost_large_rotation_mean_stress(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                    const OstElasticity *elasticity, const OstSimd *u, OstSimd stress[6])
{
    const OstQuadrature *rule = element->rule(x, elasticity);
    Tets tets = {.element = element, .formulation = formulation, .x = x, .u = u};
    OstSimd now = {0};
    prepare(&tets, elasticity);
    memset(stress, 0, 6 * sizeof *stress);
    for (int q = 0; q < rule->count; q++) {
        OstPoint point;
        OstSimd tau[6], jacobian;
        element->evaluate(x, &rule->point[q], &point);
        kirchhoff(&tets, elasticity, ost_elasticity_at(elasticity, q), rule->point[q].at, &point, tau, &jacobian);
        now += point.volume / tets.means.volume * jacobian;
        for (int p = 0; p < 6; p++)
            stress[p] += point.volume / tets.means.volume * tau[p];
    }
    ost_divide_by_volume(&now, stress);
}

void ost_large_rotation_stress_at(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                  const OstElasticity *elasticity, const OstElasticity *at_points, int points,
                                  const OstQuadraturePoint *at, const OstSimd *u, OstSimd *stress)
{
    Tets tets = {.element = element, .formulation = formulation, .x = x, .u = u};
    prepare(&tets, elasticity);
    for (int q = 0; q < points; q++, stress += 6) {
        OstPoint point;
        OstSimd jacobian;
        element->evaluate(x, &at[q], &point);
        kirchhoff(&tets, at_points, ost_elasticity_at(at_points, q), at[q].at, &point, stress, &jacobian);
        ost_divide_by_volume(&jacobian, stress);
    }
}

void ost_large_rotation_nodal_stress(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                     const OstElasticity *elasticity, const OstElasticity *at_nodes, const OstSimd *u,
                                     OstSimd *stress)
{
    OstQuadraturePoint node[OST_MAX_TET_NODES] = {{.weight = 1.0}};
    for (int a = 0; a < element->nodes; a++)
        for (int end = 0; end < 2; end++)
            node[a].at[ost_tet10_ends[a][end]] += 0.5;
    ost_large_rotation_stress_at(element, formulation, x, elasticity, at_nodes, element->nodes, node, u, stress);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/biot.h"
#include "element/large_rotation.h"
#include "element/strain_batch.h"
#include "element/tets.h"

#include <math.h>
#include <string.h>

/* Where a tet is crushed flat, its stress is that of this share of its volume. */
static const double least_volume = 1e-6;

/* One point: Kirchhoff's stress P F' (its symmetric part, which is all of it), and det F. */
static void kirchhoff(const OstElement *element, const OstElasticity *elasticity, int place, const OstSimd *stiff,
                      const OstSimd *u, const OstPoint *point, OstSimd tau[6], OstSimd *jacobian)
{
    OstSimd slope[9], strain[6], elastic[6], stress[6], piola[9];
    OstPolar polar;
    ost_displacement_gradient(element->nodes, point, u, slope);
    ost_polar(slope, &polar);
    ost_biot_strain(&polar, strain);
    ost_elastic_strain(elasticity, place, strain, elastic);
    ost_simd_stress(elasticity->c[place], elastic, stress);
    for (int p = 0; p < 6 && elasticity->by_mean; p++)
        stress[p] += *stiff * elasticity->m[place][p];
    ost_biot_piola(&polar, stress, piola);
    for (int p = 0; p < 6; p++) {
        const int i = p % 3;
        const int j = p < 3 ? p : (p + 1) % 3;
        tau[p] = 0.5 * (piola[3 * i + j] + piola[3 * j + i]);
        for (int k = 0; k < 3; k++)
            tau[p] += 0.5 * (piola[3 * i + k] * slope[3 * j + k] + piola[3 * j + k] * slope[3 * i + k]);
    }
    *jacobian = polar.stretch[0] * polar.stretch[1] * polar.stretch[2];
}

static void divide_by_volume(const OstSimd *jacobian, OstSimd stress[6])
{
    OstSimd volume;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        volume[slot] = copysign(fmax(fabs((*jacobian)[slot]), least_volume), (*jacobian)[slot]);
    for (int p = 0; p < 6; p++)
        stress[p] /= volume;
}

void ost_large_rotation_mean_stress(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                    const OstSimd *u, OstSimd stress[6])
{
    const OstQuadrature *rule = element->rule(x, elasticity);
    OstMeans means;
    OstSimd now = {0};
    ost_large_rotation_means(element, x, elasticity, u, &means);
    memset(stress, 0, 6 * sizeof *stress);
    for (int q = 0; q < rule->count; q++) {
        OstPoint point;
        OstSimd tau[6], jacobian;
        element->evaluate(x, &rule->point[q], &point);
        kirchhoff(element, elasticity, ost_elasticity_at(elasticity, q), &means.stiff, u, &point, tau, &jacobian);
        now += point.volume / means.volume * jacobian;
        for (int p = 0; p < 6; p++)
            stress[p] += point.volume / means.volume * tau[p];
    }
    divide_by_volume(&now, stress);
}

void ost_large_rotation_nodal_stress(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                     const OstElasticity *at_nodes, const OstSimd *u, OstSimd *stress)
{
    OstMeans means;
    ost_large_rotation_means(element, x, elasticity, u, &means);
    for (int a = 0; a < element->nodes; a++, stress += 6) {
        OstQuadraturePoint node = {.weight = 1.0};
        OstPoint point;
        OstSimd jacobian;
        for (int end = 0; end < 2; end++)
            node.at[ost_tet10_ends[a][end]] += 0.5;
        element->evaluate(x, &node, &point);
        kirchhoff(element, at_nodes, ost_elasticity_at(at_nodes, a), &means.stiff, u, &point, stress, &jacobian);
        divide_by_volume(&jacobian, stress);
    }
}

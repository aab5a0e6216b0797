/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_POINT_STRESS_H
#define ORTHOSTAT_ELEMENT_POINT_STRESS_H

#include "element/element.h"
#include "element/strain_batch.h"

/* The stress of linear theory at a point of the quadrature, from the displacement's gradient there; `at`: which C the
 * point has. `means` is read where the stiff mode is taken by its mean. */
static inline void ost_point_stress(const OstElasticity *elasticity, const OstQuadraturePoint *point, int at,
                                    const OstSimd gradient[9], const OstMeans *means, OstSimd stress[6])
{
    OstSimd strain[6], elastic[6];
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = (i + 1) % 3;
        strain[p] = p < 3 ? gradient[4 * i] : gradient[3 * i + j] + gradient[3 * j + i];
    }
    ost_elastic_strain(elasticity, at, strain, elastic);
    ost_simd_stress(elasticity->c[at], elastic, stress);
    for (int p = 0; p < 6 && elasticity->by_mean; p++)
        stress[p] += means->stiff * elasticity->m[at][p];
    if (elasticity->mixed) {
        OstSimd pressure;
        ost_pressure_at(elasticity, point->at, &pressure);
        for (int p = 0; p < 6; p++)
            stress[p] += pressure * elasticity->m[at][p];
    }
}

#endif

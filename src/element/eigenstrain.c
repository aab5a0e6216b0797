/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/elasticity.h"

/* What varies within a tet is evaluated where C is. */
void ost_eigenstrain_gather(OstElasticity *elasticity, const OstMaterialField *field,
                            const OstLocal tets[OST_SIMD_WIDTH], const OstQuadraturePoint *at, const OstSimd *places)
{
    for (int point = 0; point < elasticity->points; point++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const double *there = elasticity->points > 1 && at ? at[point].at : NULL;
            double axes[9], strain[6] = {0.0};
            double place[3] = {0.0};
            for (int i = 0; i < 3 && elasticity->points > 1 && field->region_formula; i++)
                place[i] = places[3 * point + i][slot];
            if (elasticity->points > 1)
                ost_field_axes_at(field, tets[slot], there, place, axes);
            else
                ost_field_axes(field, tets[slot], axes);
            ost_field_add_eigenstrain(field, tets[slot], there, elasticity->eigen_share, axes, strain);
            for (int p = 0; p < 6; p++)
                elasticity->e0[point][p][slot] = strain[p];
        }
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/elasticity.h"

/* Axes by a formula are evaluated where C is; the others are those of the tet. */
void ost_eigenstrain_gather(OstElasticity *elasticity, const OstMaterialField *field,
                            const OstLocal tets[OST_SIMD_WIDTH], const OstSimd *places)
{
    for (int point = 0; point < elasticity->points; point++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double axes[9], strain[6] = {0.0};
            if (elasticity->points > 1 && field->region_formula) {
                const OstSimd *place = places + 3 * point;
                ost_field_axes_at(field, tets[slot], (const double[3]){place[0][slot], place[1][slot], place[2][slot]},
                                  axes);
            } else
                ost_field_axes(field, tets[slot], axes);
            ost_field_add_eigenstrain(field, tets[slot], elasticity->eigen_share, axes, strain);
            for (int p = 0; p < 6; p++)
                elasticity->e0[point][p][slot] = strain[p];
        }
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/element.h"

#include "element/tets.h"

#include <stddef.h>
#include <string.h>

const OstElement *ost_element_of(int nodes_per_tet)
{
    static const OstElement *const kinds[] = {&ost_tet4, &ost_tet10};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (kinds[i]->nodes == nodes_per_tet)
            return kinds[i];
    return NULL;
}

void ost_vary_axes(const OstMaterialField *field, OstLocal tet, const OstQuadrature *rule, const double *weight,
                   const double *x, const double *stress, double more[6])
{
    double own[9], there[9];
    memset(more, 0, 6 * sizeof *more);
    ost_field_axes(field, tet, own);
    for (int q = 0; q < rule->count; q++) {
        double along_own[6], along_there[6];
        ost_field_axes_at(field, tet, rule->point[q].at, x + 3 * q, there);
        ost_tensor_along(stress + 6 * q, own, along_own);
        ost_tensor_along(stress + 6 * q, there, along_there);
        for (int p = 0; p < 6; p++)
            more[p] += weight[q] * (along_there[p] - along_own[p]);
    }
}

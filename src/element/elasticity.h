/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_ELASTICITY_H
#define ORTHOSTAT_ELEMENT_ELASTICITY_H

#include "element/element.h"
#include "orthostat/field.h"

/* C in world axes of the tets in the lanes (upper triangle). Kept from one group of tets to the next, because many
 * bodies have one C for all. */
typedef struct OstElasticity {
    OstLanes c[OST_ELASTICITY_COUNT];
    int32_t region; /* every lane holds this region's one C; -1: not so */
} OstElasticity;

/* Start value: nothing is held yet. */
static inline void ost_elasticity_clear(OstElasticity *elasticity)
{
    elasticity->region = -1;
}

/* Local. Takes up the tets in the lanes. */
void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES]);

/* Stress = C strain, 6×6 row-major. */
static inline void ost_stress(const double stiffness[36], const double strain[6], double stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = 0.0;
        for (int q = 0; q < 6; q++)
            stress[p] += stiffness[6 * p + q] * strain[q];
    }
}

#endif

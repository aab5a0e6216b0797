/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_ELASTICITY_H
#define ORTHOSTAT_ELEMENT_ELASTICITY_H

#include "element/lanes.h"
#include "orthostat/field.h"

/* Points of a tet at which C may differ: quadrature points, or nodes. */
enum { OST_MAX_POINTS = 10, OST_ELASTICITY_COUNT = 21 };

/* C in world axes of the tets in the lanes, as upper triangles: 21 numbers row by row (11 12 .. 16 22 .. 66), strains
 * in the order 11 22 33 12 23 31 with engineering shear. Kept from one group of tets to the next, because many bodies
 * have one C for all.
 *
 * Where part of a region's C sees a mean alone (ost_field_mean_dilatation), C is split: C = c + m m', with c the softer
 * rest. The energy density of a tet is then 1/2 strain'c strain + 1/2 (mean of m'strain)^2. */
typedef struct OstElasticity {
    int points;     /* 1: the same all over each tet; or as many as were asked for */
    int by_mean;    /* is C split? */
    int32_t region; /* every lane holds this region's one C; -1: not so */
    OstLanes c[OST_MAX_POINTS][OST_ELASTICITY_COUNT];
    OstLanes m[OST_MAX_POINTS][6]; /* zero in the lanes that are not split; not set if by_mean is 0 */
} OstElasticity;

/* Start value: nothing is held yet. */
static inline void ost_elasticity_clear(OstElasticity *elasticity)
{
    elasticity->region = -1;
}

/* Local. Takes up the tets in the lanes. `places` are `points` points in each of them (3 numbers a point): C is
 * evaluated there if the axes of any of the tets come from a formula. Linear tets pass 0 and NULL: C is that at their
 * centroids, and never split, since their strain is its own mean. */
void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES],
                           int points, const OstLanes *places);

/* Where the C of a point is. */
static inline int ost_elasticity_at(const OstElasticity *elasticity, int point)
{
    return elasticity->points == 1 ? 0 : point;
}

#endif

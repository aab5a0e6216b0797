/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_ELASTICITY_H
#define ORTHOSTAT_ELEMENT_ELASTICITY_H

#include "element/lanes.h"
#include "material/field_data.h"

/* Points of a tet at which C may differ: quadrature points, or nodes. */
enum { OST_MAX_POINTS = 10, OST_ELASTICITY_COUNT = 21 };

/* C in world axes of the tets in the lanes, as upper triangles: 21 numbers row by row (11 12 .. 16 22 .. 66), strains
 * in the order 11 22 33 12 23 31 with engineering shear. Kept from one group of tets to the next, because many bodies
 * have one C for all.
 *
 * Where part of a region's C sees a mean alone (ost_field_mean_dilatation), C is split: C = c + m m', with c the softer
 * rest. The energy density of a tet is then 1/2 strain'c strain + 1/2 (mean of m'strain)^2.
 *
 * The stable family with geometric shear (eq. 18 and 22), and with it every isotropic body, is isotropic elasticity in
 * a stretched metric: with A = sum of sqrt(C_aa) e_a e_a' over the axes, and `shear` = C_44 / sqrt(C_11 C_22), C_ijkl =
 * (1 - 2 shear) A_ij A_kl + shear (A_ik A_jl + A_il A_jk). From A, C comes more cheaply than by rotation, and the
 * stiffness of a linear tet more cheaply still, without C. */
typedef struct OstElasticity {
    int points;     /* 1: the same all over each tet; or as many as were asked for */
    int by_mean;    /* is C split? */
    int32_t region; /* what is held serves every tet of this region; -1: not so */

    int metric_suffices; /* set by who has no need of c and m where there is A (linear tets alone) */
    int by_metric;       /* is C known by A, and c not set? */
    int about_line;      /* if so: is A not set, but had from the place by ost_metric_about_line? */
    OstLanes metric[6];  /* A_11 A_22 A_33 A_12 A_23 A_31 */

    int32_t examined; /* the region, or -1, that these are about: */
    int stretched;    /* is it of the family? */
    double stretch[3];
    double shear;
    int cylindrical;                /* is A that of axes about a line, so that it comes from the place alone? */
    OstLanes origin[3], axis[3];    /* four times a point of the line, and its direction */
    OstLanes about_axis[6], radial; /* A = about_axis + radial d d' / d'd, d the place's distance from the line */

    OstLanes c[OST_MAX_POINTS][OST_ELASTICITY_COUNT];
    OstLanes m[OST_MAX_POINTS][6]; /* zero in the lanes that are not split; not set if by_mean is 0 */
} OstElasticity;

/* Start value: nothing is held yet. */
static inline void ost_elasticity_clear(OstElasticity *elasticity)
{
    elasticity->region = -1;
    elasticity->metric_suffices = 0;
    elasticity->by_metric = 0;
    elasticity->about_line = 0;
    elasticity->examined = -1;
}

/* Local. Takes up the tets in the lanes. `places` are `points` points in each of them (3 numbers a point): C is
 * evaluated there if the axes of any of the tets come from a formula. Linear tets pass 0: C is that at their centroids,
 * and never split, since their strain is its own mean; where A suffices and the axes are cylindrical, nothing is taken
 * up but the line, and A had by ost_metric_about_line, which is cheaper than to read the axes from memory. */
void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES],
                           int points, const OstLanes *places);

/* A at the centroids of tets with these corners, where axes turn about a line. */
static inline void ost_metric_about_line(const OstElasticity *elasticity, const OstLanes x[12], OstLanes metric[6])
{
    const OstLanes *axis = elasticity->axis;
    OstLanes d[3]; /* four times the distance, whose length does not matter */
    for (int i = 0; i < 3; i++)
        d[i] = x[i] + x[3 + i] + x[6 + i] + x[9 + i] - elasticity->origin[i];
    const OstLanes height = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
    for (int i = 0; i < 3; i++)
        d[i] -= height * axis[i];
    const OstLanes share = elasticity->radial / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++) {
        const OstLanes part = share * d[i];
        metric[i] = elasticity->about_axis[i] + part * d[i];
        metric[3 + i] = elasticity->about_axis[3 + i] + part * d[(i + 1) % 3];
    }
}

/* Where the C of a point is. */
static inline int ost_elasticity_at(const OstElasticity *elasticity, int point)
{
    return elasticity->points == 1 ? 0 : point;
}

#endif

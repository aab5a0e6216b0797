/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_FIELD_DATA_H
#define ORTHOSTAT_MATERIAL_FIELD_DATA_H

#include "effect/effect.h"
#include "orthostat/field.h"

/* Elasticity and axes of every tet of a rank's piece, holding no more than the scene calls for: an isotropic body
 * carries no axes; a region with fixed axes one rotated tensor; only regions whose axes vary keep axes by tet. */
struct OstMaterialField {
    OstContext *ctx;
    int region_count;
    OstMaterial *material;        /* region_count */
    double *region_stiffness;     /* region_count × 36, world axes; of use where the region's axes do not vary */
    double *region_axes;          /* region_count × 9; NULL if no material is orthotropic */
    unsigned char *region_varies; /* region_count */
    double *tet_axes;             /* NULL if no orthotropic region's axes vary; else tet_count × 9 (rows e1 e2 e3) */
    const int32_t *tet_region;    /* the mesh's; not owned */

    /* region_count, NULL where axes do not come from a formula; NULL if they nowhere do. */
    struct OstAxesFormula **region_formula;

    /* NULL, or region_count × 3: stress of the mode that sees its mean alone (ost_field_mean_dilatation), along the
     * material axes; zero in regions without. */
    double *region_stiff_mode;
    double *region_rest; /* NULL likewise, or region_count × 36: C without it, in material axes */
};

/* Local. C of a tet in world axes. */
void ost_field_stiffness(const OstMaterialField *field, OstLocal tet, double stiffness[36]);

/* Local. The metric in which a tet is isotropic, R' diag(√(E_min / E_k)) R, as 11 22 33 12 23 31: short along what is
 * stiff, Euclid's along the softest direction. */
void ost_field_metric(const OstMaterialField *field, OstLocal tet, double metric[6]);

/* Local. Does a region's axes come from a formula, so that they can be had at any point? */
int ost_field_has_formula(const OstMaterialField *field, int32_t region);

/* Local. Axes at a point of a tet: by the formula, or the tet's own where there is none, or where it is not defined (on
 * a cylinder's axis, which is no more than a line). */
void ost_field_axes_at(const OstMaterialField *field, OstLocal tet, const double point[3], double axes[9]);

/* Local. Density of a tet. */
double ost_field_density(const OstMaterialField *field, OstLocal tet);

/* Local. A field of `region_count` materials (copied) with the regions' axes given by `specs` (NULL: none), evaluated
 * at the `tet_count` centroids. Regions of kind OST_AXES_CELLS and OST_AXES_GRADIENT take them from `given_axes`
 * (tet_count × 9, NULL if no region asks). `effects` are the scene's (NULL: what the materials and axes ask for is
 * made); OST_EFFECT_REGIONS, OST_EFFECT_ORTHOTROPY, OST_EFFECT_VARYING_AXES. Left-handed or skew axes are refused,
 * naming the tet by tet_label. */
OstStatus ost_field_create(OstContext *ctx, const OstEffects *effects, int region_count, const OstMaterial *materials,
                           const OstAxesSpec *specs, OstLocal tet_count, const int32_t *tet_region,
                           const OstGlobal *tet_label, const double *centroids, const double *given_axes,
                           OstMaterialField **field);

/* Local. m of a region along its axes (three numbers), or NULL if its C is not split. */
const double *ost_field_stiff_mode(const OstMaterialField *field, int32_t region);

/* Local. C - m m' of such a region in material axes (36 numbers), or NULL. It is not had by that difference, which
 * would be wrong by the rounding of what is taken away, and that is as large as 1/e: near nu = 1/2 all of it. */
const double *ost_field_rest(const OstMaterialField *field, int32_t region);

#endif

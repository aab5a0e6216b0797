/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FIELD_H
#define ORTHOSTAT_FIELD_H

#include "orthostat/axes.h"
#include "orthostat/material.h"

/* Elasticity and axes of every tet of a rank's piece, holding no more than the scene calls for: an isotropic body
 * carries no axes; a region with fixed axes one rotated tensor; only regions whose axes vary keep axes by tet. */
typedef struct OstMaterialField {
    OstContext *ctx;
    int region_count;
    OstMaterial *material;        /* region_count */
    double *region_stiffness;     /* region_count × 36, world axes; of use where the region's axes do not vary */
    double *region_axes;          /* region_count × 9; NULL if no material is orthotropic */
    unsigned char *region_varies; /* region_count */
    double *tet_axes;             /* NULL if no orthotropic region's axes vary; else tet_count × 9 (rows e1 e2 e3) */
    const int32_t *tet_region;    /* the mesh's; not owned */
} OstMaterialField;

/* Local. C of a tet in world axes. */
void ost_field_stiffness(const OstMaterialField *field, OstLocal tet, double stiffness[36]);

/* Local. Axes of a tet (the world's where the body carries none). */
void ost_field_axes(const OstMaterialField *field, OstLocal tet, double axes[9]);

/* Local. Density of a tet. */
double ost_field_density(const OstMaterialField *field, OstLocal tet);

/* Local. A field of `region_count` materials (copied) with the regions' axes given by `specs` (NULL: none), evaluated
 * at the `tet_count` centroids. Regions of kind OST_AXES_CELLS and OST_AXES_GRADIENT take them from `given_axes`
 * (tet_count × 9, NULL if no region asks). Left-handed or skew axes are refused, naming the tet by tet_label. */
OstStatus ost_field_create(OstContext *ctx, int region_count, const OstMaterial *materials, const OstAxesSpec *specs,
                           OstLocal tet_count, const int32_t *tet_region, const OstGlobal *tet_label,
                           const double *centroids, const double *given_axes, OstMaterialField **field);
void ost_field_destroy(OstMaterialField **field);

#endif

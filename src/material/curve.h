/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_CURVE_H
#define ORTHOSTAT_MATERIAL_CURVE_H

#include "orthostat/axes.h"

/* A polyline with the tangent and normal of each vertex. */
typedef struct OstCurve {
    OstContext *ctx;
    const OstAxesSpec *spec; /* not owned */
    double *tangent;         /* point_count × 3 */
    double *normal;          /* point_count × 3; NULL if the normal comes from `up` */
} OstCurve;

/* Local. Raises OST_INVALID_INPUT for fewer than two points, points that are not finite or repeat, and a curve that
 * turns back on itself. */
OstStatus ost_curve_create(OstContext *ctx, const OstAxesSpec *spec, OstCurve **curve);
void ost_curve_destroy(OstCurve **curve);

/* Local. Axes at the point of the curve nearest to `point`. */
OstStatus ost_curve_axes(const OstCurve *curve, const double point[3], double axes[9]);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_AXES_FORMULA_H
#define ORTHOSTAT_MATERIAL_AXES_FORMULA_H

#include "material/curve.h"

/* Axes that vary by a formula, with a copy of their specification and what need be computed only once. */
typedef struct OstAxesFormula {
    OstContext *ctx;
    OstAxesSpec spec; /* owns its points */
    OstCurve *curve;  /* of OST_AXES_CURVE, otherwise NULL */
} OstAxesFormula;

/* Do axes of this kind vary by a formula? */
static inline int ost_axes_have_formula(const OstAxesSpec *spec)
{
    return spec->kind == OST_AXES_CYLINDRICAL || spec->kind == OST_AXES_CURVE;
}

/* Local. Copies the spec. */
OstStatus ost_axes_formula_create(OstContext *ctx, const OstAxesSpec *spec, OstAxesFormula **formula);
void ost_axes_formula_destroy(OstAxesFormula **formula);

/* Local. As ost_axes_at. */
OstStatus ost_axes_formula_at(const OstAxesFormula *formula, const double point[3], double axes[9]);

#endif

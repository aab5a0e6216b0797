/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/axes_formula.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static OstStatus copy_points(OstAxesFormula *formula, const OstAxesSpec *spec)
{
    const size_t count = 3 * (size_t)spec->point_count;
    formula->spec.points = NULL;
    if (spec->point_count <= 0 || !spec->points)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(formula->ctx, &formula->spec.points, count));
    memcpy(formula->spec.points, spec->points, count * sizeof *spec->points);
    return OST_SUCCESS;
}

OstStatus ost_axes_formula_create(OstContext *ctx, const OstAxesSpec *spec, OstAxesFormula **out)
{
    OstAxesFormula *formula = NULL;
    OstStatus status = OST_SUCCESS;
    *out = NULL;
    OST_TRY(OST_NEW(ctx, &formula, 1));
    formula->ctx = ctx;
    formula->spec = *spec;
    OST_TRY_DONE(copy_points(formula, spec));
    if (spec->kind == OST_AXES_CURVE)
        OST_TRY_DONE(ost_curve_create(ctx, &formula->spec, &formula->curve));
    *out = formula;
    return OST_SUCCESS;
done:
    ost_axes_formula_destroy(&formula);
    return status;
}

void ost_axes_formula_destroy(OstAxesFormula **formula)
{
    if (!*formula)
        return;
    ost_curve_destroy(&(*formula)->curve);
    OST_FREE((*formula)->spec.points);
    OST_FREE(*formula);
}

OstStatus ost_axes_formula_at(const OstAxesFormula *formula, const double point[3], double axes[9])
{
    if (formula->curve)
        return ost_curve_axes(formula->curve, point, axes);
    return ost_axes_at(formula->ctx, &formula->spec, point, axes);
}

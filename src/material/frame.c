/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/frame.h"

#include "core/error.h"
#include "material/curve.h"

#include <string.h>

/* A direction this small, relative to what it was taken from, is rounding. */
static const double vanishing = 1e-8;

int ost_axes_vary(const OstAxesSpec *spec)
{
    switch (spec->kind) {
    case OST_AXES_NONE:
    case OST_AXES_FIXED:
    case OST_AXES_EULER:
    case OST_AXES_QUATERNION:
        return 0;
    case OST_AXES_CYLINDRICAL:
    case OST_AXES_CURVE:
    case OST_AXES_CELLS:
    case OST_AXES_GRADIENT:
        return 1;
    }
    return 0;
}

OstStatus ost_frame_in_order(OstContext *ctx, const OstCylindricalDirection order[3], const double frame[9],
                             double axes[9])
{
    const int a = (int)order[0], b = (int)order[1], c = (int)order[2];
    if (a < 0 || a > 2 || b < 0 || b > 2 || c < 0 || c > 2 || a == b || b == c || c == a)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "order of the axes %d %d %d; axial, radial and tangential, each once, are expected", a, b, c);
    const double sign = (b - a + 3) % 3 == 1 ? 1.0 : -1.0;
    for (int i = 0; i < 3; i++) {
        axes[i] = frame[3 * a + i];
        axes[3 + i] = frame[3 * b + i];
        axes[6 + i] = sign * frame[3 * c + i];
    }
    return OST_SUCCESS;
}

static OstStatus cylindrical_axes(OstContext *ctx, const OstAxesSpec *spec, const double point[3], double axes[9])
{
    double frame[9], offset[3];
    const double length = ost_norm3(spec->axis);
    if (!(length > 0.0) || !isfinite(length))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "cylindrical axes about the direction (%g, %g, %g); a finite vector other than 0 is expected",
                         spec->axis[0], spec->axis[1], spec->axis[2]);
    for (int i = 0; i < 3; i++) {
        frame[i] = spec->axis[i] / length;
        offset[i] = point[i] - spec->origin[i];
    }
    memcpy(frame + 3, offset, sizeof offset);
    if (!(ost_make_orthogonal3(frame, frame + 3) > vanishing * ost_norm3(offset)))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the point (%g, %g, %g) lies on the cylinder's axis, where radial and tangential are not "
                         "defined; move the axis, or give this region other axes",
                         point[0], point[1], point[2]);
    ost_complete_frame(frame);
    return ost_frame_in_order(ctx, spec->order, frame, axes);
}

static OstStatus curve_axes(OstContext *ctx, const OstAxesSpec *spec, const double point[3], double axes[9])
{
    OstCurve *curve = NULL;
    OST_TRY(ost_curve_create(ctx, spec, &curve));
    const OstStatus status = ost_curve_axes(curve, point, axes);
    ost_curve_destroy(&curve);
    return status;
}

OstStatus ost_axes_at(OstContext *ctx, const OstAxesSpec *spec, const double point[3], double axes[9])
{
    switch (spec->kind) {
    case OST_AXES_NONE:
        memcpy(axes, (double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 9 * sizeof(double));
        return OST_SUCCESS;
    case OST_AXES_FIXED:
    case OST_AXES_EULER:
    case OST_AXES_QUATERNION:
        memcpy(axes, spec->fixed, sizeof spec->fixed);
        return ost_axes_check(ctx, "fixed axes", axes);
    case OST_AXES_CYLINDRICAL:
        return cylindrical_axes(ctx, spec, point, axes);
    case OST_AXES_CURVE:
        return curve_axes(ctx, spec, point, axes);
    case OST_AXES_CELLS:
    case OST_AXES_GRADIENT:
        break;
    }
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "axes given by tet or by gradients have no formula to evaluate at a point");
}

OstStatus ost_axes_from_gradients(OstContext *ctx, const double g1[3], const double g2[3], double axes[9])
{
    const double length1 = ost_norm3(g1);
    const double length2 = ost_norm3(g2);
    if (!isfinite(length1) || !isfinite(length2) || !(length1 > vanishing * length2))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the first potential's gradient (%g, %g, %g) gives no direction for e1; its two boundaries "
                         "must differ, and reach every part of the body",
                         g1[0], g1[1], g1[2]);
    memcpy(axes, g1, 3 * sizeof(double));
    memcpy(axes + 3, g2, 3 * sizeof(double));
    ost_normalise3(axes);
    if (!(ost_make_orthogonal3(axes, axes + 3) > vanishing * fmax(length1, length2)))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the second potential's gradient (%g, %g, %g) vanishes or is parallel to the first's (%g, %g, "
                         "%g), and gives no direction for e2; choose boundaries that lie across",
                         g2[0], g2[1], g2[2], g1[0], g1[1], g1[2]);
    ost_complete_frame(axes);
    return OST_SUCCESS;
}

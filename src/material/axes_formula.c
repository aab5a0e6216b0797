/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/axes_formula.h"

#include "core/error.h"
#include "core/memory.h"
#include "material/frame.h"

#include <string.h>

/* Below this sine (about a thousandth of a degree) an angle counts as 0: the curve turns back, or is parallel to up. */
static const double smallest_sine = 1e-5;

static int same_point(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static void segment_direction(const OstAxesSpec *spec, int k, double direction[3])
{
    for (int i = 0; i < 3; i++)
        direction[i] = spec->points[3 * (k + 1) + i] - spec->points[3 * k + i];
    ost_normalise3(direction);
}

static OstStatus check_points(OstContext *ctx, const OstAxesSpec *spec)
{
    if (spec->point_count < 2)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "axes along a curve of %d points; at least 2 are expected",
                         spec->point_count);
    for (int k = 0; k < 3 * spec->point_count; k++)
        if (!isfinite(spec->points[k]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "point %d of the axes' curve is not finite (%g)", k / 3 + 1,
                             spec->points[k]);
    for (int i = 0; i < 3; i++)
        if (!isfinite(spec->up[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "the up direction of the axes' curve is not finite (%g)",
                             spec->up[i]);
    for (int k = 0; k + 1 < spec->point_count; k++)
        if (same_point(spec->points + 3 * k, spec->points + 3 * (k + 1)))
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "points %d and %d of the axes' curve are the same; leave one of them out", k + 1, k + 2);
    return OST_SUCCESS;
}

static int is_closed(const OstAxesSpec *spec)
{
    const int last = spec->point_count - 1;
    return last > 2 && same_point(spec->points, spec->points + 3 * last);
}

/* The mean direction of the segments before and after vertex k. */
static OstStatus vertex_tangent(OstContext *ctx, const OstAxesSpec *spec, int k, double tangent[3])
{
    const int last = spec->point_count - 1;
    const int closed = is_closed(spec);
    double before[3], after[3];
    segment_direction(spec, k > 0 ? k - 1 : (closed ? last - 1 : 0), before);
    segment_direction(spec, k < last ? k : (closed ? 0 : last - 1), after);
    for (int i = 0; i < 3; i++)
        tangent[i] = before[i] + after[i];
    if (ost_norm3(tangent) < smallest_sine)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the axes' curve turns straight back at point %d, where it has no tangent", k + 1);
    ost_normalise3(tangent);
    return OST_SUCCESS;
}

/* Parallel transport: the normal turns from vertex to vertex by the smallest rotation that takes tangent to tangent. */
static void carry_normals(const OstAxesFormula *curve)
{
    const double *t = curve->tangent;
    double *n = curve->normal;
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(t[i]) < fabs(t[least]))
            least = i;
    n[least] = 1.0;
    ost_make_orthogonal3(t, n);
    ost_normalise3(n);
    for (int k = 1; k < curve->spec.point_count; k++) {
        const double *from = t + 3 * (k - 1), *to = t + 3 * k;
        const double factor = ost_dot3(to, n + 3 * (k - 1)) / (1.0 + ost_dot3(from, to));
        for (int i = 0; i < 3; i++)
            n[3 * k + i] = n[3 * (k - 1) + i] - factor * (from[i] + to[i]);
        ost_make_orthogonal3(to, n + 3 * k);
        ost_normalise3(n + 3 * k);
    }
}

static OstStatus prepare_curve(OstAxesFormula *formula)
{
    const OstAxesSpec *spec = &formula->spec;
    OST_TRY(check_points(formula->ctx, spec));
    OST_TRY(OST_NEW(formula->ctx, &formula->tangent, 3 * spec->point_count));
    for (int k = 0; k < spec->point_count; k++)
        OST_TRY(vertex_tangent(formula->ctx, spec, k, formula->tangent + 3 * k));
    if (ost_norm3(spec->up) == 0.0) {
        OST_TRY(OST_NEW(formula->ctx, &formula->normal, 3 * spec->point_count));
        carry_normals(formula);
    }
    return OST_SUCCESS;
}

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
        OST_TRY_DONE(prepare_curve(formula));
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
    OST_FREE((*formula)->tangent, (*formula)->normal, (*formula)->spec.points);
    OST_FREE(*formula);
}

/* The segment nearest to a point, and the position on it (0 to 1). */
static int nearest_segment(const OstAxesSpec *spec, const double point[3], double *where)
{
    int nearest = 0;
    double smallest = INFINITY;
    for (int k = 0; k + 1 < spec->point_count; k++) {
        const double *a = spec->points + 3 * k;
        const double side[3] = {a[3] - a[0], a[4] - a[1], a[5] - a[2]};
        const double offset[3] = {point[0] - a[0], point[1] - a[1], point[2] - a[2]};
        const double s = fmin(fmax(ost_dot3(offset, side) / ost_dot3(side, side), 0.0), 1.0);
        const double gap[3] = {offset[0] - s * side[0], offset[1] - s * side[1], offset[2] - s * side[2]};
        const double distance = ost_dot3(gap, gap);
        if (distance < smallest) {
            smallest = distance;
            nearest = k;
            *where = s;
        }
    }
    return nearest;
}

static void interpolate(const double *vertex_vector, double where, double v[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = (1.0 - where) * vertex_vector[i] + where * vertex_vector[3 + i];
}

/* Axes at the point of the curve nearest to `point`. */
static OstStatus curve_axes(const OstAxesFormula *curve, const double point[3], double axes[9])
{
    double frame[9], where = 0.0;
    const OstAxesSpec *spec = &curve->spec;
    const int k = nearest_segment(spec, point, &where);
    interpolate(curve->tangent + 3 * k, where, frame);
    ost_normalise3(frame);
    if (curve->normal)
        interpolate(curve->normal + 3 * k, where, frame + 3);
    else
        memcpy(frame + 3, spec->up, sizeof spec->up);
    if (!(ost_make_orthogonal3(frame, frame + 3) > smallest_sine * (curve->normal ? 1.0 : ost_norm3(spec->up))))
        return OST_RAISE(curve->ctx, OST_INVALID_INPUT,
                         "near the point (%g, %g, %g) the curve's tangent is parallel to up (%g, %g, %g), so the "
                         "normal is not defined; choose another up, or none",
                         point[0], point[1], point[2], spec->up[0], spec->up[1], spec->up[2]);
    ost_complete_frame(frame);
    return ost_frame_in_order(curve->ctx, spec->order, frame, axes);
}

OstStatus ost_axes_formula_at(const OstAxesFormula *formula, const double point[3], double axes[9])
{
    if (formula->tangent)
        return curve_axes(formula, point, axes);
    return ost_axes_at(formula->ctx, &formula->spec, point, axes);
}

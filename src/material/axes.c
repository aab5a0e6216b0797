/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/axes.h"

#include "core/error.h"
#include "material/axes_formula.h"
#include "material/frame.h"

#include <string.h>

/* The user's axes may deviate from orthonormal by this. */
static const double given_tolerance = 1e-6;

/* A vector that was computed as a difference is rounding error if it is this small, relative to what it came from. */
static const double vanishing = 1e-8;

/* Checked before the lengths: rows that are skew are often not of unit length either, and then the angle is the cause.
 */
static OstStatus check_angles(OstContext *ctx, const char *what, const double axes[9])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const double lengths = ost_norm3(axes + 3 * i) * ost_norm3(axes + 3 * j);
        const double cosine = ost_dot3(axes + 3 * i, axes + 3 * j) / lengths;
        if (lengths > 0.0 && fabs(cosine) > given_tolerance)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "%s: e%d and e%d are not orthogonal (%.9g degrees lie between them); orthonormal axes are "
                             "expected",
                             what, i + 1, j + 1, acos(fmax(-1.0, fmin(1.0, cosine))) * 180.0 / M_PI);
    }
    return OST_SUCCESS;
}

static OstStatus check_rows(OstContext *ctx, const char *what, const double axes[9])
{
    for (int i = 0; i < 9; i++)
        if (!isfinite(axes[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: component %d of e%d is %g; a finite number is expected", what,
                             i % 3 + 1, i / 3 + 1, axes[i]);
    OST_TRY(check_angles(ctx, what, axes));
    for (int i = 0; i < 3; i++) {
        const double length = ost_norm3(axes + 3 * i);
        if (fabs(length - 1.0) > given_tolerance)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: e%d has length %.9g; a unit vector is expected", what, i + 1,
                             length);
    }
    if (ost_determinant3(axes) < 0.0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "%s: the axes are left-handed; e3 = e1 × e2 is expected, so reverse one of them", what);
    return OST_SUCCESS;
}

OstStatus ost_axes_check(OstContext *ctx, const char *what, double axes[9])
{
    OST_TRY(check_rows(ctx, what, axes));
    /* Newton's iteration A <- A (3 - AᵀA) / 2 to the nearest rotation: the error falls from 1e-6 to 1e-12 to rounding.
     */
    for (int step = 0; step < 2; step++) {
        double product[9], old[9];
        memcpy(old, axes, sizeof old);
        ost_multiply3_transposed_left(old, old, product);
        for (int i = 0; i < 9; i++)
            product[i] = 0.5 * ((i % 4 == 0 ? 3.0 : 0.0) - product[i]);
        ost_multiply3(old, product, axes);
    }
    return OST_SUCCESS;
}

static int is_sequence(const char *sequence)
{
    if (strlen(sequence) != 3)
        return 0;
    if (strspn(sequence, "xyz") != 3 && strspn(sequence, "XYZ") != 3)
        return 0;
    return sequence[0] != sequence[1] && sequence[1] != sequence[2];
}

/* Turns the rows of `axes` by an angle about world axis `about`. */
static void turn_rows(int about, double degrees, double axes[9])
{
    const double c = cos(degrees * M_PI / 180.0);
    const double s = sin(degrees * M_PI / 180.0);
    const int j = (about + 1) % 3;
    const int k = (about + 2) % 3;
    for (int row = 0; row < 3; row++) {
        double *e = axes + 3 * row;
        const double e_j = e[j];
        e[j] = c * e_j - s * e[k];
        e[k] = s * e_j + c * e[k];
    }
}

OstStatus ost_axes_from_euler(OstContext *ctx, const char *sequence, const double degrees[3], double axes[9])
{
    if (!is_sequence(sequence))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "Euler sequence '%s'; three letters of xyz (turned frame) or XYZ (fixed frame) are expected, "
                         "no two neighbours alike, such as zxz",
                         sequence);
    for (int i = 0; i < 3; i++)
        if (!isfinite(degrees[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "Euler angle %d is %g; finite degrees are expected", i + 1,
                             degrees[i]);
    const int fixed_frame = sequence[0] < 'a';
    memcpy(axes, (double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 9 * sizeof(double));
    for (int step = 0; step < 3; step++) {
        /* Rotations about the turned frame's axes are those about the fixed frame's in reverse order. */
        const int i = fixed_frame ? step : 2 - step;
        turn_rows(sequence[i] - (fixed_frame ? 'X' : 'x'), degrees[i], axes);
    }
    return OST_SUCCESS;
}

OstStatus ost_axes_from_quaternion(OstContext *ctx, const double quaternion[4], double axes[9])
{
    double largest = 0.0;
    int finite = 1;
    for (int i = 0; i < 4; i++) {
        finite &= isfinite(quaternion[i]) != 0;
        largest = fmax(largest, fabs(quaternion[i]));
    }
    if (!finite || largest == 0.0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "quaternion (%g, %g, %g, %g); finite numbers w x y z, not all zero, are expected",
                         quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    double q[4], square = 0.0;
    for (int i = 0; i < 4; i++) {
        q[i] = quaternion[i] / largest;
        square += q[i] * q[i];
    }
    const double length = sqrt(square);
    const double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
    const double rows[9] = {
        1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z),       2.0 * (x * z - w * y),
        2.0 * (x * y - w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x),
        2.0 * (x * z + w * y),       2.0 * (y * z - w * x),       1.0 - 2.0 * (x * x + y * y),
    };
    memcpy(axes, rows, sizeof rows);
    return OST_SUCCESS;
}

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
    case OST_AXES_FIELD:
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
    OstAxesFormula *curve = NULL;
    OST_TRY(ost_axes_formula_create(ctx, spec, &curve));
    const OstStatus status = ost_axes_formula_at(curve, point, axes);
    ost_axes_formula_destroy(&curve);
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
    case OST_AXES_FIELD:
        break;
    }
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "axes given by tet or by gradients have no formula to evaluate at a point");
}

/* The world axis that is least along d. */
static void any_other(const double d[3], double other[3])
{
    int least = 0;
    for (int i = 0; i < 3; i++) {
        other[i] = 0.0;
        least = fabs(d[i]) < fabs(d[least]) ? i : least;
    }
    other[least] = 1.0;
}

OstStatus ost_axes_from_directions(OstContext *ctx, const int along[2], const double d1[3], const double *d2,
                                   double axes[9])
{
    double frame[9];
    const double length1 = ost_norm3(d1), length2 = d2 ? ost_norm3(d2) : 1.0;
    const int first = along[0], second = !d2 || along[1] == first ? (first + 1) % 3 : along[1];
    if (!(length1 > 0.0) || !isfinite(length1) || !(length2 > 0.0) || !isfinite(length2))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the direction (%g, %g, %g) is zero or not finite, and gives no axis",
                         length1 > 0.0 && isfinite(length1) ? d2[0] : d1[0],
                         length1 > 0.0 && isfinite(length1) ? d2[1] : d1[1],
                         length1 > 0.0 && isfinite(length1) ? d2[2] : d1[2]);
    memcpy(frame, d1, 3 * sizeof *frame);
    ost_normalise3(frame);
    if (d2)
        memcpy(frame + 3, d2, 3 * sizeof *frame);
    else
        any_other(frame, frame + 3);
    if (!(ost_make_orthogonal3(frame, frame + 3) > vanishing * length2))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the directions (%g, %g, %g) and (%g, %g, %g) are parallel, and give one axis only", d1[0],
                         d1[1], d1[2], d2 ? d2[0] : 0.0, d2 ? d2[1] : 0.0, d2 ? d2[2] : 0.0);
    ost_complete_frame(frame);
    const int third = 3 - first - second;
    const double sign = (second - first + 3) % 3 == 1 ? 1.0 : -1.0; /* right-handed, and both as they were stated */
    for (int i = 0; i < 3; i++) {
        axes[3 * first + i] = frame[i];
        axes[3 * second + i] = frame[3 + i];
        axes[3 * third + i] = sign * frame[6 + i];
    }
    return OST_SUCCESS;
}

OstStatus ost_axes_from_gradients(OstContext *ctx, const double g1[3], const double g2[3], double axes[9])
{
    const double length1 = ost_norm3(g1);
    const double length2 = ost_norm3(g2);
    if (!isfinite(length1) || !isfinite(length2) || !(length1 > vanishing * length2))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the first potential's gradient (%g, %g, %g) gives no direction for e1; its two boundaries "
                         "must differ, and reach every connected component of the region",
                         g1[0], g1[1], g1[2]);
    memcpy(axes, g1, 3 * sizeof(double));
    memcpy(axes + 3, g2, 3 * sizeof(double));
    ost_normalise3(axes);
    if (!(ost_make_orthogonal3(axes, axes + 3) > vanishing * fmax(length1, length2)))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the second potential's gradient (%g, %g, %g) vanishes or is parallel to the first's (%g, %g, "
                         "%g), and gives no direction for e2; choose boundaries that lie across the first ones",
                         g2[0], g2[1], g2[2], g1[0], g1[1], g1[2]);
    ost_complete_frame(axes);
    return OST_SUCCESS;
}

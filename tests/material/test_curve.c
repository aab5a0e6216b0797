/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "material/random.h"

static OstAxesSpec along(int point_count, double *points)
{
    return (OstAxesSpec){.kind = OST_AXES_CURVE,
                         .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL},
                         .point_count = point_count,
                         .points = points};
}

static void a_straight_curve_has_one_frame(void **state)
{
    double points[6] = {0, 0, 0, 0, 0, 4};
    OstAxesSpec spec = along(2, points);
    spec.up[1] = 3.0;
    spec.up[2] = 1.0;
    for (int trial = 0; trial < 20; trial++) {
        const double point[3] = {random_between(-2, 2), random_between(-2, 2), random_between(-2, 6)};
        double axes[9];
        assert_success(ost_axes_at(ctx, &spec, point, axes));
        assert_axes(axes, (const double[9]){0, 0, 1, 0, 1, 0, -1, 0, 0}, 1e-15);
    }
}

enum { ARC_POINTS = 91 };

/* A quarter circle of radius 5 in the plane z = 1, from (5, 0, 1) to (0, 5, 1), a point a degree. */
static void make_arc(double points[3 * ARC_POINTS])
{
    for (int k = 0; k < ARC_POINTS; k++) {
        points[3 * k] = 5.0 * cos(k * M_PI / 180);
        points[3 * k + 1] = 5.0 * sin(k * M_PI / 180);
        points[3 * k + 2] = 1.0;
    }
}

static void axes_along_an_arc_are_those_of_the_circle(void **state)
{
    double points[3 * ARC_POINTS];
    make_arc(points);
    OstAxesSpec spec = along(ARC_POINTS, points);
    spec.up[2] = 1.0;
    for (int trial = 0; trial < 200; trial++) {
        /* The first and the last segment lean towards their ends. */
        const double angle = random_between(2.0, 88.0) * M_PI / 180, radius = random_between(4.5, 5.5);
        const double point[3] = {radius * cos(angle), radius * sin(angle), random_between(0.5, 1.5)};
        const double c = cos(angle), s = sin(angle);
        double axes[9];
        assert_success(ost_axes_at(ctx, &spec, point, axes));
        assert_rotation(axes);
        /* tangent, up, tangent × up; a degree's chord and arc differ by its square over 24, and beside the curve the
         * wedges of the vertices take up to the distance's part of half a degree */
        const double tolerance = 3e-5 + fabs(radius - 5.0) / 5.0 * 0.5 * M_PI / 180;
        assert_axes(axes, (const double[9]){-s, c, 0, 0, 0, 1, c, s, 0}, tolerance);
    }
}

static double largest_step(const OstAxesSpec *spec, const double from[3], const double to[3], int steps)
{
    double before[9], axes[9], largest = 0.0;
    assert_success(ost_axes_at(ctx, spec, from, before));
    for (int k = 1; k <= steps; k++) {
        double point[3];
        for (int i = 0; i < 3; i++)
            point[i] = from[i] + (to[i] - from[i]) * k / steps;
        assert_success(ost_axes_at(ctx, spec, point, axes));
        for (int i = 0; i < 9; i++)
            largest = fmax(largest, fabs(axes[i] - before[i]));
        memcpy(before, axes, sizeof axes);
    }
    return largest;
}

static void axes_vary_continuously_round_sharp_corners(void **state)
{
    double points[12] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 2, 2, 3};
    OstAxesSpec spec = along(4, points);
    for (int with_up = 0; with_up < 2; with_up++) {
        spec.up[0] = with_up * 1.0;
        spec.up[1] = with_up * -1.0;
        spec.up[2] = with_up * 0.3;
        for (int k = 0; k < 3; k++) {
            const double coarse = largest_step(&spec, points + 3 * k, points + 3 * k + 3, 500);
            const double fine = largest_step(&spec, points + 3 * k, points + 3 * k + 3, 5000);
            assert_true(coarse < 0.02);
            assert_close(fine, coarse / 10, coarse / 40); /* steps shrink with the distance: no jump */
        }
        /* outside the corner, where the vertex is nearest to a whole wedge of points */
        const double from[3] = {1.9, -0.5, 0}, to[3] = {2.5, 0.1, 0};
        assert_true(largest_step(&spec, from, to, 2000) < 0.01);
    }
}

static void the_normal_of_a_plane_stays_when_carried_along_in_it(void **state)
{
    double points[3 * ARC_POINTS];
    make_arc(points);
    const OstAxesSpec spec = along(ARC_POINTS, points);
    for (int k = 0; k < ARC_POINTS; k++) {
        double axes[9];
        assert_success(ost_axes_at(ctx, &spec, points + 3 * k, axes));
        assert_rotation(axes);
        for (int i = 0; i < 3; i++) /* it starts as z, the world axis that is orthogonal to the first tangent */
            assert_close(axes[3 + i], i == 2 ? 1.0 : 0.0, 1e-15);
    }
}

/* On a helix the normal with least turning turns against the binormal by the torsion: after one turn of radius r and
 * rise h, by the angle 2π (1 - h / sqrt((2πr)² + h²)) (the sphere's area that the tangent goes round). */
static void normals_turn_least_along_a_helix(void **state)
{
    enum { COUNT = 2001 };
    const double r = 1.0, h = 3.0;
    double points[3 * COUNT], first[9], last[9];
    for (int k = 0; k < COUNT; k++) {
        const double angle = 2 * M_PI * (k - 1.5) / (COUNT - 4); /* the turn ends amid a segment, the curve goes on */
        points[3 * k] = r * cos(angle);
        points[3 * k + 1] = r * sin(angle);
        points[3 * k + 2] = h * angle / (2 * M_PI);
    }
    const OstAxesSpec spec = along(COUNT, points);
    const double start[3] = {r, 0, 0}, end[3] = {r, 0, h};
    assert_success(ost_axes_at(ctx, &spec, start, first));
    assert_success(ost_axes_at(ctx, &spec, end, last));
    double cosine = 0.0;
    for (int i = 0; i < 3; i++) {
        assert_close(first[i], last[i], 1e-5);
        cosine += first[3 + i] * last[3 + i];
    }
    assert_close(cosine, cos(2 * M_PI * (1 - h / hypot(2 * M_PI * r, h))), 1e-4);
}

static void a_closed_curve_has_one_tangent_where_it_closes(void **state)
{
    double points[15] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 1, 0, 0};
    OstAxesSpec spec = along(5, points);
    spec.up[2] = 1.0;
    const double point[3] = {1.5, 0, 0};
    double axes[9];
    assert_success(ost_axes_at(ctx, &spec, point, axes));
    assert_axes(axes, (const double[9]){0, 1, 0, 0, 0, 1, 1, 0, 0}, 1e-15);
}

static void useless_curves_are_refused(void **state)
{
    double points[9] = {0, 0, 0, 1, 0, 0, 1, 0, 0}, back[9] = {0, 0, 0, 1, 0, 0, 0.5, 0, 0};
    double broken[6] = {0, 0, 0, 1, INFINITY, 0};
    const double point[3] = {0.2, 1, 0};
    double axes[9];
    OstAxesSpec spec = along(3, points);
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "points 2 and 3 of the axes' curve");
    spec = along(3, back);
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "turns straight back at point 2");
    spec = along(2, broken);
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "point 2 of the axes' curve is not finite");
    spec = along(1, points);
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "at least 2 are expected");
    spec = along(2, points);
    spec.up[0] = -4.0;
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "parallel to up (-4, 0, 0)");
    spec.up[0] = NAN;
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "up direction");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_straight_curve_has_one_frame),
    cmocka_unit_test(axes_along_an_arc_are_those_of_the_circle),
    cmocka_unit_test(axes_vary_continuously_round_sharp_corners),
    cmocka_unit_test(the_normal_of_a_plane_stays_when_carried_along_in_it),
    cmocka_unit_test(normals_turn_least_along_a_helix),
    cmocka_unit_test(a_closed_curve_has_one_tangent_where_it_closes),
    cmocka_unit_test(useless_curves_are_refused),
};

OST_TEST_MAIN(tests)

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "support.h"

#include "material/random.h"

static void axes_are_made_orthonormal_to_rounding(void **state)
{
    for (int trial = 0; trial < 200; trial++) {
        double axes[9], given[9];
        random_axes(axes);
        for (int i = 0; i < 9; i++)
            given[i] = axes[i] + random_between(-3e-7, 3e-7);
        assert_success(ost_axes_check(ctx, "axes", given));
        assert_rotation(given);
        assert_axes(given, axes, 1e-6);
    }
}

static void left_handed_axes_are_refused(void **state)
{
    double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1};
    assert_failure(ost_axes_check(ctx, "tet 12", axes), OST_INVALID_INPUT, "tet 12: the axes are left-handed");
}

static void skew_stretched_and_broken_axes_are_refused(void **state)
{
    double skew[9] = {1, 0, 0, 0.6, 0.8, 0, 0, 0, 1};
    double leaning[9] = {1, 0, 0, 3, 4, 0, 0, 0, 1};
    double slightly_skew[9] = {1, 0, 0, 2e-6, 1, 0, 0, 0, 1};
    double stretched[9] = {1, 0, 0, 0, 1.5, 0, 0, 0, 1};
    double zero[9] = {1, 0, 0, 0, 1, 0, 0, 0, 0};
    double broken[9] = {1, 0, 0, 0, 1, NAN, 0, 0, 1};
    assert_failure(ost_axes_check(ctx, "wood", skew), OST_INVALID_INPUT, "wood: e1 and e2 are not orthogonal");
    /* atan(4/3) */
    assert_failure(ost_axes_check(ctx, "wood", leaning), OST_INVALID_INPUT, "(53.1301024 degrees lie between them)");
    assert_failure(ost_axes_check(ctx, "wood", slightly_skew), OST_INVALID_INPUT, "e1 and e2 are not orthogonal");
    assert_failure(ost_axes_check(ctx, "wood", stretched), OST_INVALID_INPUT, "e2 has length 1.5");
    assert_failure(ost_axes_check(ctx, "wood", zero), OST_INVALID_INPUT, "e3 has length 0");
    assert_failure(ost_axes_check(ctx, "wood", broken), OST_INVALID_INPUT, "component 3 of e2 is nan");
}

/* R = Rz(a) Rx(b) Rz(c) multiplied out by hand; rows of `axes` are its columns. */
static void euler_angles_turn_about_the_turned_frame(void **state)
{
    const double degrees[3] = {20, 50, -35};
    const double a = degrees[0] * M_PI / 180, b = degrees[1] * M_PI / 180, c = degrees[2] * M_PI / 180;
    const double expected[9] = {cos(a) * cos(c) - sin(a) * cos(b) * sin(c),
                                sin(a) * cos(c) + cos(a) * cos(b) * sin(c),
                                sin(b) * sin(c),
                                -cos(a) * sin(c) - sin(a) * cos(b) * cos(c),
                                -sin(a) * sin(c) + cos(a) * cos(b) * cos(c),
                                sin(b) * cos(c),
                                sin(a) * sin(b),
                                -cos(a) * sin(b),
                                cos(b)};
    double axes[9];
    assert_success(ost_axes_from_euler(ctx, "zxz", degrees, axes));
    assert_axes(axes, expected, 1e-15);
    assert_rotation(axes);
}

static void fixed_and_turned_sequences_mirror_each_other(void **state)
{
    const double degrees[3] = {10, 70, 130}, reversed[3] = {130, 70, 10};
    double fixed[9], turned[9];
    assert_success(ost_axes_from_euler(ctx, "XYZ", degrees, fixed));
    assert_success(ost_axes_from_euler(ctx, "zyx", reversed, turned));
    assert_axes(fixed, turned, 1e-15);
    const double quarter_about_x_then_y[3] = {90, 90, 0}; /* e1 = -z, e2: y to z to x, e3: z to -y, stays */
    assert_success(ost_axes_from_euler(ctx, "XYZ", quarter_about_x_then_y, fixed));
    assert_axes(fixed, (const double[9]){0, 0, -1, 1, 0, 0, 0, -1, 0}, 1e-15);
}

static void unknown_sequences_and_angles_are_refused(void **state)
{
    static const char *const bad[] = {"zz", "zzx", "xyw", "xYz", "zxzx", ""};
    const double degrees[3] = {1, 2, 3}, broken[3] = {1, INFINITY, 3};
    double axes[9];
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_failure(ost_axes_from_euler(ctx, bad[i], degrees, axes), OST_INVALID_INPUT, "Euler sequence");
    assert_failure(ost_axes_from_euler(ctx, "zxz", broken, axes), OST_INVALID_INPUT, "Euler angle 2 is inf");
}

static void quaternions_agree_with_euler_angles(void **state)
{
    const double half = 25.0 * M_PI / 180;
    const double about_y[4] = {7 * cos(half), 0, 7 * sin(half), 0}, degrees[3] = {0, 50, 0};
    const double tiny[4] = {1e-200 * cos(half), 0, 1e-200 * sin(half), 0};
    double axes[9], expected[9];
    assert_success(ost_axes_from_euler(ctx, "xyz", degrees, expected));
    assert_success(ost_axes_from_quaternion(ctx, about_y, axes));
    assert_axes(axes, expected, 1e-15);
    assert_success(ost_axes_from_quaternion(ctx, tiny, axes));
    assert_axes(axes, expected, 1e-15);
    for (int trial = 0; trial < 100; trial++) {
        random_axes(axes);
        assert_rotation(axes);
    }
    const double zero[4] = {0}, broken[4] = {1, NAN, 0, 0}, broken_first[4] = {NAN, 1, 0, 0};
    assert_failure(ost_axes_from_quaternion(ctx, zero, axes), OST_INVALID_INPUT, "not all zero");
    assert_failure(ost_axes_from_quaternion(ctx, broken, axes), OST_INVALID_INPUT, "finite");
    assert_failure(ost_axes_from_quaternion(ctx, broken_first, axes), OST_INVALID_INPUT, "finite");
}

/* For every pair: the first as it is stated, the second as far as it is orthogonal to the first; none is turned round.
 */
static void two_directions_keep_their_senses(void **state)
{
    const double d1[3] = {3, 0, 4}, d2[3] = {1, 2, 0};
    for (int first = 0; first < 3; first++)
        for (int second = 0; second < 3; second++) {
            const int along[2] = {first, second};
            double axes[9];
            if (first == second)
                continue;
            assert_success(ost_axes_from_directions(ctx, along, d1, d2, axes));
            assert_rotation(axes);
            assert_close(ost_dot3(axes + 3 * first, d1), 5.0, 1e-14);
            assert_true(ost_dot3(axes + 3 * second, d2) > 0.0);
        }
}

static void fixed_axes_are_the_same_everywhere(void **state)
{
    OstAxesSpec spec = {.kind = OST_AXES_FIXED, .fixed = {0, 1, 0, 0, 0, 1, 1, 0, 0}};
    const double point[3] = {3, -2, 8};
    double axes[9];
    assert_success(ost_axes_at(ctx, &spec, point, axes));
    assert_axes(axes, spec.fixed, 0.0);
    spec.kind = OST_AXES_NONE;
    assert_success(ost_axes_at(ctx, &spec, point, axes));
    assert_axes(axes, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 0.0);
    spec.kind = OST_AXES_CELLS;
    assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "no formula");
}

static void kinds_that_vary_say_so(void **state)
{
    for (OstAxesKind kind = OST_AXES_NONE; kind <= OST_AXES_GRADIENT; kind++) {
        const OstAxesSpec spec = {.kind = kind};
        assert_int_equal(ost_axes_vary(&spec), kind >= OST_AXES_CYLINDRICAL);
    }
}

static void cylindrical_axes_follow_the_wall(void **state)
{
    const OstAxesSpec spec = {.kind = OST_AXES_CYLINDRICAL,
                              .origin = {1, 2, 3},
                              .axis = {0, 5, 0},
                              .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}};
    for (int k = 0; k < 12; k++) {
        const double angle = k * M_PI / 6, c = cos(angle), s = sin(angle);
        const double point[3] = {1 + 1.2 * c, -7.0, 3 + 1.2 * s};
        double axes[9];
        assert_success(ost_axes_at(ctx, &spec, point, axes));
        /* tangential = y × radial */
        assert_axes(axes, (const double[9]){0, 1, 0, c, 0, s, s, 0, -c}, 1e-14);
        assert_rotation(axes);
    }
}

static void every_order_of_the_frame_is_right_handed(void **state)
{
    for (int m = 0; m < 27; m++) {
        const int a = m / 9, b = m / 3 % 3, c = m % 3;
        const OstAxesSpec spec = {
            .kind = OST_AXES_CYLINDRICAL,
            .axis = {0, 0, 1},
            .order = {(OstCylindricalDirection)a, (OstCylindricalDirection)b, (OstCylindricalDirection)c}};
        const double point[3] = {2, 0, 0}, frame[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
        double axes[9];
        if (a == b || b == c || c == a) {
            assert_failure(ost_axes_at(ctx, &spec, point, axes), OST_INVALID_INPUT, "each once");
            continue;
        }
        assert_success(ost_axes_at(ctx, &spec, point, axes));
        assert_rotation(axes);
        const double sign = (a == 0 && b == 1) || (a == 1 && b == 2) || (a == 2 && b == 0) ? 1.0 : -1.0;
        for (int i = 0; i < 3; i++) {
            assert_close(axes[i], frame[3 * a + i], 0.0);
            assert_close(axes[3 + i], frame[3 * b + i], 0.0);
            assert_close(axes[6 + i], sign * frame[3 * c + i], 0.0);
        }
    }
}

static void points_on_the_cylinders_axis_are_refused(void **state)
{
    OstAxesSpec spec = {.kind = OST_AXES_CYLINDRICAL,
                        .origin = {1, 1, 1},
                        .axis = {1, 1, 1},
                        .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}};
    const double on_axis[3] = {5, 5, 5}, off_axis[3] = {5, 5, 5.001};
    double axes[9];
    assert_failure(ost_axes_at(ctx, &spec, on_axis, axes), OST_INVALID_INPUT, "lies on the cylinder's axis");
    assert_failure(ost_axes_at(ctx, &spec, spec.origin, axes), OST_INVALID_INPUT, "lies on the cylinder's axis");
    assert_success(ost_axes_at(ctx, &spec, off_axis, axes));
    assert_rotation(axes);
    spec.axis[0] = spec.axis[1] = spec.axis[2] = 0.0;
    assert_failure(ost_axes_at(ctx, &spec, off_axis, axes), OST_INVALID_INPUT, "finite vector other than 0");
}

static void gradients_give_axes_in_harmony(void **state)
{
    for (int trial = 0; trial < 200; trial++) {
        double g1[3], g2[3], axes[9], scaled[9], along = 0.0, across = 0.0, rest = 0.0, norm = 0.0;
        for (int i = 0; i < 3; i++) {
            g1[i] = random_between(-1.0, 1.0);
            g2[i] = random_between(-1.0, 1.0) + 100.0 * (trial % 2) * g1[i];
        }
        assert_success(ost_axes_from_gradients(ctx, g1, g2, axes));
        assert_rotation(axes);
        for (int i = 0; i < 3; i++) {
            along += axes[i] * g1[i];
            norm += g1[i] * g1[i];
            across += axes[3 + i] * g2[i];
            rest += axes[6 + i] * g2[i];
        }
        assert_close(along, sqrt(norm), 1e-15 * 8); /* e1 along g1 */
        assert_true(across > 0.0);                  /* e2 on g2's side, in the plane of both: none of g2 along e3 */
        assert_close(rest, 0.0, 1e-12);
        for (int i = 0; i < 3; i++) { /* only directions count */
            g1[i] *= 4.0;
            g2[i] *= 1024.0;
        }
        assert_success(ost_axes_from_gradients(ctx, g1, g2, scaled));
        assert_axes(scaled, axes, 0.0);
    }
}

static void gradients_without_direction_are_refused(void **state)
{
    const double g[3] = {1, 2, 3}, parallel[3] = {2, 4, 6}, zero[3] = {0}, tiny[3] = {1e-12, 0, 0};
    const double broken[3] = {1, NAN, 0};
    double axes[9];
    assert_failure(ost_axes_from_gradients(ctx, zero, g, axes), OST_INVALID_INPUT, "no direction for e1");
    assert_failure(ost_axes_from_gradients(ctx, tiny, g, axes), OST_INVALID_INPUT, "no direction for e1");
    assert_failure(ost_axes_from_gradients(ctx, broken, g, axes), OST_INVALID_INPUT, "no direction for e1");
    assert_failure(ost_axes_from_gradients(ctx, g, zero, axes), OST_INVALID_INPUT, "no direction for e2");
    assert_failure(ost_axes_from_gradients(ctx, g, tiny, axes), OST_INVALID_INPUT, "no direction for e2");
    assert_failure(ost_axes_from_gradients(ctx, g, parallel, axes), OST_INVALID_INPUT, "no direction for e2");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(axes_are_made_orthonormal_to_rounding),
    cmocka_unit_test(left_handed_axes_are_refused),
    cmocka_unit_test(skew_stretched_and_broken_axes_are_refused),
    cmocka_unit_test(euler_angles_turn_about_the_turned_frame),
    cmocka_unit_test(fixed_and_turned_sequences_mirror_each_other),
    cmocka_unit_test(unknown_sequences_and_angles_are_refused),
    cmocka_unit_test(quaternions_agree_with_euler_angles),
    cmocka_unit_test(two_directions_keep_their_senses),
    cmocka_unit_test(fixed_axes_are_the_same_everywhere),
    cmocka_unit_test(kinds_that_vary_say_so),
    cmocka_unit_test(cylindrical_axes_follow_the_wall),
    cmocka_unit_test(every_order_of_the_frame_is_right_handed),
    cmocka_unit_test(points_on_the_cylinders_axis_are_refused),
    cmocka_unit_test(gradients_give_axes_in_harmony),
    cmocka_unit_test(gradients_without_direction_are_refused),
};

OST_TEST_MAIN(tests)

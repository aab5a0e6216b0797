/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"
#include "problem/scene_data.h"
#include "solve/buckling/buckling.h"

/* Load factors of columns and beams of length 1 along x, clamped at x = 0, of quadratic tets, against formulas. */
static const double pi = 3.14159265358979;

#define COLUMN "mesh: {block: {size: [1, 0.06, 0.04], divisions: [12, 1, 1]}}\nelement: {order: 2}\n"
#define ISOTROPIC "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0}]\n"
#define CLAMPED "{on: {boundary: xmin}, displacement: [0, 0, 0]}"
#define PRESSED "loads: [{on: {boundary: xmax}, total_force: [-1, 0, 0]}]\n"
#define LINEAR "large_rotation: off\n"
#define MODES "buckling: {modes: 2}\n"

/* Euler's load of a column, on the way to bend along its height, with what shear takes from it (F. Engesser 1891: S.
 * Timoshenko and J. Gere, Theory of elastic stability, 1961, 2.17); `effective`: its length times this. */
static double euler(double width, double height, double modulus, double shear, double effective)
{
    const double bends = pi * pi * modulus * width * height * height * height / 12.0 / (effective * effective);
    return bends / (1.0 + 1.2 * bends / (shear * width * height));
}

typedef struct Solved {
    OstCase *c;
    OstScene *scene;
    OstResult *result;
    OstStatus status;
} Solved;

static void destroy(Solved *solved)
{
    ost_result_destroy(&solved->result);
    ost_scene_destroy(&solved->scene);
    ost_case_destroy(&solved->c);
}

static const OstBuckling *solve(const char *text, Solved *solved)
{
    *solved = (Solved){0};
    assert_success(read_text(text, &solved->c));
    assert_success(ost_scene_create(solved->c, &solved->scene));
    solved->status = ost_scene_solve(solved->scene, &solved->result);
    return ost_result_buckling(solved->result);
}

static void assert_factors(const char *text, double first, double second, double tolerance)
{
    Solved solved;
    const OstBuckling *buckling = solve(text, &solved);
    assert_success(solved.status);
    assert_true(buckling->known && buckling->converged);
    assert_true(buckling->iterations <= 15); /* 3 to 8 */
    assert_close(buckling->factor[0], first, tolerance * first);
    if (second > 0.0)
        assert_close(buckling->factor[1], second, tolerance * second);
    destroy(&solved);
}

static void columns_buckle_at_eulers_load(void **state)
{
    const double shear = 5e5;
    assert_factors(COLUMN ISOTROPIC "constraints: [" CLAMPED "]\n" PRESSED LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 2.0), euler(0.04, 0.06, 1e6, shear, 2.0), 0.01);
    /* held across at the other end, whose face may turn */
    assert_factors(COLUMN ISOTROPIC "constraints: [" CLAMPED
                                    ", {on: {boundary: xmax}, displacement: [free, 0, 0]}]\n" PRESSED LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 0.6992), euler(0.04, 0.06, 1e6, shear, 0.6992), 0.015);
    /* the end's face stays plane, as in the formula */
    assert_factors(COLUMN ISOTROPIC "constraints: [" CLAMPED
                                    ", {on: {boundary: xmax}, rigid: [1, 0.03, 0.02]}]\n" PRESSED LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 2.0), euler(0.04, 0.06, 1e6, shear, 2.0), 0.01);
    /* pressed at the end of a rigid lever, half as long: kL tan kL = 2 */
    assert_factors(COLUMN ISOTROPIC
                   "constraints: [" CLAMPED ", {on: {boundary: xmax}, rigid: [1, 0.03, 0.02]}]\n"
                   "loads: [{on: {boundary: xmax}, total_force: [-1, 0, 0], at: [1.5, 0.03, 0.02]}]\n" LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 2.9173), euler(0.04, 0.06, 1e6, shear, 2.9173), 0.001);
}

/* An end that is moved in the mean: by as much as a force of 1 would. Its multiplier turns with its point, and what is
 * held no motion changes. */
#define MOVED(at, motion) \
    "loads: [{on: {boundary: xmax}, distributing: {at: [" at ", 0.03, 0.02], displacement: " motion "}}]\n"

static void a_column_that_a_coupling_presses_buckles_at_eulers_load(void **state)
{
    const double shear = 5e5;
    assert_factors(COLUMN ISOTROPIC "constraints: [" CLAMPED "]\n" MOVED("1", "[-0.0004166666666667, free, free]")
                       LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 2.0), euler(0.04, 0.06, 1e6, shear, 2.0), 0.01);
    assert_factors(COLUMN ISOTROPIC "constraints: [" CLAMPED "]\n" MOVED("1.5", "[-0.0004166666666667, free, free]")
                       LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 2.9173), euler(0.04, 0.06, 1e6, shear, 2.9173), 0.001);
    assert_factors(COLUMN ISOTROPIC "constraints: [" CLAMPED
                                    "]\n" MOVED("1", "[-0.0004166666666667, free, free], rotation: [0, 0, 0]")
                                        LINEAR MODES,
                   euler(0.06, 0.04, 1e6, shear, 1.0), euler(0.04, 0.06, 1e6, shear, 1.0), 0.01);
}

/* Of the mixed form: nothing holds the clamped end's face from widening. Linear theory is no answer beyond the load. */
#define INCOMPRESSIBLE                                                                           \
    COLUMN "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.5}]\nconstraints: " \
           "[{on: {boundary: xmin}, displacement: [0, free, free]}, "                            \
           "{on: {nearest: [0, 0.03, 0.02]}, displacement: [0, 0, 0]}, "                         \
           "{on: {nearest: [0, 0.06, 0.02]}, displacement: [0, free, 0]}]\n" PRESSED

static void an_incompressible_column_buckles_at_eulers_load(void **state)
{
    const double factor[] = {euler(0.06, 0.04, 1e6, 1e6 / 3.0, 2.0), euler(0.04, 0.06, 1e6, 1e6 / 3.0, 2.0)};
    Solved solved;
    assert_factors(INCOMPRESSIBLE LINEAR MODES, factor[0], factor[1], 0.005);
    const OstBuckling *buckling = solve(INCOMPRESSIBLE, &solved);
    assert_int_equal(solved.status, OST_CHECK_FAILED);
    assert_close(buckling->factor[0], factor[0], 0.03 * factor[0]);
    destroy(&solved);
}

/* E G = 10: without what shear takes the column of fibres would bear 3 % more. */
static void a_column_of_fibres_buckles_at_eulers_load(void **state)
{
    assert_factors(COLUMN "materials: [{region: all, youngs_modulus: [1e7, 1e6, 1e6], poissons_ratio: 0, "
                          "shear_modulus: {G12: 2e5, G23: 5e5, G31: 2e5}}]\nconstraints: [" CLAMPED
                          "]\n" PRESSED LINEAR MODES,
                   euler(0.06, 0.04, 1e7, 2e5, 2.0), euler(0.04, 0.06, 1e7, 2e5, 2.0), 0.01);
}

/* Clamped at both ends, it is under the force of the strain that it cannot take. */
static void a_column_that_swells_buckles(void **state)
{
    const double load = euler(0.06, 0.04, 1e6, 5e5, 0.5), strain = load / (1e6 * 0.06 * 0.04);
    assert_factors(COLUMN "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0, eigenstrain: 0.001}]\n"
                          "constraints: [" CLAMPED ", {on: {boundary: xmax}, displacement: [0, 0, 0]}]\n" LINEAR
                          "buckling: on\n",
                   strain / 0.001, 0.0, 0.02);
}

/* A deep cantilever tips over sideways at 4.013 sqrt(EI GJ) / L² (Timoshenko and Gere, 6.5); the clamped end, where it
 * cannot warp, makes it 5 % stiffer. */
#define DEEP "mesh: {block: {size: [1, 0.004, 0.04], divisions: [48, 1, 3]}}\nelement: {order: 2}\n"

static double tipping(void)
{
    const double t = 0.004, h = 0.04, bends = 1e6 * h * t * t * t / 12.0;
    return 4.013 * sqrt(bends * 5e5 * h * t * t * t / 3.0 * (1.0 - 0.63 * t / h));
}

static void a_deep_beam_tips_over_sideways(void **state)
{
    assert_factors(DEEP ISOTROPIC "constraints: [" CLAMPED
                                  "]\nloads: [{on: {boundary: xmax}, total_force: [0, 0, -1e-3]}]\n" LINEAR
                                  "buckling: on\n",
                   1e3 * tipping(), 0.0, 0.06);
}

/* Linear theory is refused beyond the load, looked at by Newton's method near it, and taken below. */
static void what_has_buckled_is_no_answer(void **state)
{
    const double load = tipping(), share[] = {1.2, 0.9, 0.5};
    for (int k = 0; k < 3; k++) {
        char text[1024];
        Solved solved;
        snprintf(text, sizeof text,
                 DEEP ISOTROPIC "constraints: [" CLAMPED
                                "]\nloads: [{on: {boundary: xmax}, total_force: [0, 0, -%.17g]}]\n",
                 share[k] * load);
        const OstBuckling *buckling = solve(text, &solved);
        assert_int_equal(solved.status, k == 0 ? OST_CHECK_FAILED : OST_SUCCESS);
        assert_int_equal(buckling->known, k < 2);
        assert_int_equal(ost_result_newton_report(solved.result)->used, k == 1);
        if (k < 2)
            assert_close(buckling->factor[0], 1.0 / share[k], 0.06 / share[k]);
        if (k == 0)
            assert_non_null(strstr(ost_error_text(ctx), "by linear theory the body buckles at 0.8"));
        destroy(&solved);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(columns_buckle_at_eulers_load),
    cmocka_unit_test(a_column_that_a_coupling_presses_buckles_at_eulers_load),
    cmocka_unit_test(an_incompressible_column_buckles_at_eulers_load),
    cmocka_unit_test(a_column_of_fibres_buckles_at_eulers_load),
    cmocka_unit_test(a_column_that_swells_buckles),
    cmocka_unit_test(a_deep_beam_tips_over_sideways),
    cmocka_unit_test(what_has_buckled_is_no_answer),
};

OST_TEST_MAIN(tests)

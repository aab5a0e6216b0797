/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/material.h"
#include "support.h"

/* A pine, in MPa: e1 along the fibre. */
static const OstStrength pine = {.known = 1,
                                 .tension = {80.0, 3.0, 3.0},
                                 .compression = {45.0, 6.0, 6.0},
                                 .shear = {8.0, 3.0, 8.0},
                                 .interaction = {-0.5, -0.5, -0.5}};

/* Tension and compression alone fail at their strengths by every criterion; Hill's takes the smaller one of an axis. */
static void single_stresses_fail_at_their_strength(void **state)
{
    for (int i = 0; i < 3; i++) {
        double pull[6] = {0.0}, push[6] = {0.0}, shear[6] = {0.0};
        pull[i] = 0.1 * pine.tension[i];
        push[i] = -0.5 * pine.compression[i];
        shear[3 + i] = -4.0 * pine.shear[i];
        for (int c = 0; c < OST_CRITERIA; c++) {
            const double least = fmin(pine.tension[i], pine.compression[i]);
            assert_close(ost_load_factor(&pine, (OstCriterion)c, pull), c == OST_HILL ? least / pull[i] : 10.0, 1e-12);
            assert_close(ost_load_factor(&pine, (OstCriterion)c, push), c == OST_HILL ? -least / push[i] : 2.0, 1e-12);
            assert_close(ost_load_factor(&pine, (OstCriterion)c, shear), 0.25, 1e-13);
        }
    }
}

/* F(f s) = 1, with F written out once more. */
static void tsai_wu_is_the_root_of_its_form(void **state)
{
    const double stress[6] = {-20.0, 1.2, -2.5, 3.0, 0.7, -2.0};
    const double f = ost_load_factor(&pine, OST_TSAI_WU, stress);
    double s[6];
    for (int p = 0; p < 6; p++)
        s[p] = f * stress[p];
    const double f11 = 1.0 / (80.0 * 45.0), f22 = 1.0 / (3.0 * 6.0), f12 = -0.5 * sqrt(f11 * f22), f23 = -0.5 * f22;
    const double form = (1.0 / 80.0 - 1.0 / 45.0) * s[0] + (1.0 / 3.0 - 1.0 / 6.0) * (s[1] + s[2]) + f11 * s[0] * s[0] +
                        f22 * (s[1] * s[1] + s[2] * s[2]) + 2.0 * f12 * s[0] * (s[1] + s[2]) + 2.0 * f23 * s[1] * s[2] +
                        s[3] * s[3] / 64.0 + s[4] * s[4] / 9.0 + s[5] * s[5] / 64.0;
    assert_true(f > 0.0 && f < OST_MOST_LOAD_FACTOR);
    assert_close(form, 1.0, 1e-12);
}

/* Equal strengths everywhere, and shear of 1/sqrt(3): Hill's, and Tsai and Wu's, are von Mises's. */
static void an_isotropic_material_fails_by_von_mises(void **state)
{
    const double y = 250.0, s[6] = {100.0, -30.0, 55.0, 20.0, -40.0, 10.0};
    const OstStrength steel = {.known = 1,
                               .tension = {y, y, y},
                               .compression = {y, y, y},
                               .shear = {y / sqrt(3.0), y / sqrt(3.0), y / sqrt(3.0)},
                               .interaction = {-0.5, -0.5, -0.5}};
    const double von_mises = sqrt(0.5 * (pow(s[0] - s[1], 2) + pow(s[1] - s[2], 2) + pow(s[2] - s[0], 2)) +
                                  3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
    assert_close(ost_load_factor(&steel, OST_HILL, s), y / von_mises, 1e-12);
    assert_close(ost_load_factor(&steel, OST_TSAI_WU, s), y / von_mises, 1e-12);
    assert_close(ost_load_factor(&steel, OST_MAXIMUM_STRESS, s), 2.5, 1e-12);
    assert_false(ost_strength_has_directions(&steel));
    assert_true(ost_strength_has_directions(&pine));
}

static void what_cannot_fail_has_the_largest_factor(void **state)
{
    const double none[6] = {0.0};
    const OstStrength even = {.known = 1,
                              .tension = {1.0, 1.0, 1.0},
                              .compression = {2.0, 2.0, 2.0},
                              .shear = {1.0, 1.0, 1.0},
                              .interaction = {-0.5, -0.5, -0.5}};
    const double pressed[6] = {-5.0, -5.0, -5.0};
    for (int c = 0; c < OST_CRITERIA; c++)
        assert_true(ost_load_factor(&pine, (OstCriterion)c, none) == OST_MOST_LOAD_FACTOR);
    assert_true(ost_load_factor(&even, OST_TSAI_WU, pressed) >= OST_MOST_LOAD_FACTOR);
    assert_true(ost_load_factor(&even, OST_HILL, pressed) == OST_MOST_LOAD_FACTOR);
    assert_close(ost_load_factor(&even, OST_MAXIMUM_STRESS, pressed), 0.4, 1e-14);
}

static void open_criteria_are_known(void **state)
{
    OstStrength strength = pine;
    assert_false(ost_criterion_is_open(&strength, OST_TSAI_WU));
    assert_false(ost_criterion_is_open(&strength, OST_HILL));
    strength.tension[2] = 4.5;
    assert_true(ost_criterion_is_open(&strength, OST_HILL)); /* 80 : 3 : 4.5 */
    strength.interaction[0] = -0.9;
    assert_true(ost_criterion_is_open(&strength, OST_TSAI_WU));
    assert_false(ost_criterion_is_open(&strength, OST_MAXIMUM_STRESS));
}

/* A stress of 11 22 33 12 23 31, seen from axes turned about e1. */
static void turn(const double stress[6], double angle, double turned[6])
{
    const double c = cos(angle), s = sin(angle);
    turned[0] = stress[0];
    turned[1] = c * c * stress[1] + s * s * stress[2] + 2.0 * c * s * stress[4];
    turned[2] = s * s * stress[1] + c * c * stress[2] - 2.0 * c * s * stress[4];
    turned[3] = c * stress[3] + s * stress[5];
    turned[4] = c * s * (stress[2] - stress[1]) + (c * c - s * s) * stress[4];
    turned[5] = c * stress[5] - s * stress[3];
}

/* With that shear strength axes across the fibre may lie anywhere; with another one they may not. */
static void shear_across_makes_criteria_even(void **state)
{
    (void)state;
    const double stress[6] = {7.0, 1.0, -0.4, 0.7, 0.3, -1.1};
    double turned[6];
    turn(stress, 0.6, turned);
    for (int c = 0; c < OST_MAXIMUM_STRESS; c++) {
        OstStrength even = pine;
        even.interaction[1] = -0.3;
        const double factor = ost_load_factor(&even, (OstCriterion)c, stress);
        assert_true(fabs(ost_load_factor(&even, (OstCriterion)c, turned) / factor - 1.0) > 1e-3);
        even.shear[1] = ost_criterion_even_shear(&even, (OstCriterion)c, 0);
        assert_close(ost_load_factor(&even, (OstCriterion)c, turned), ost_load_factor(&even, (OstCriterion)c, stress),
                     1e-12);
    }
    assert_true(ost_criterion_even_shear(&pine, OST_MAXIMUM_STRESS, 0) == 0.0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(single_stresses_fail_at_their_strength),
    cmocka_unit_test(tsai_wu_is_the_root_of_its_form),
    cmocka_unit_test(an_isotropic_material_fails_by_von_mises),
    cmocka_unit_test(what_cannot_fail_has_the_largest_factor),
    cmocka_unit_test(open_criteria_are_known),
    cmocka_unit_test(shear_across_makes_criteria_even),
};

OST_TEST_MAIN(tests)

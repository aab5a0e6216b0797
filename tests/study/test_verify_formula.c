/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_text.h"
#include "core/small.h"
#include "study/formula/formula.h"

/* Closed forms against published numbers, and against the equations that any of them must satisfy. */

static const char bar[] = "mesh: {block: {origin: [0, -0.4, -0.5], size: [10, 0.8, 1], divisions: [1, 1, 1]}}\n";
static const char column[] = "mesh: {block: {origin: [-1, -0.5, 0], size: [2, 1, 3], divisions: [1, 1, 1]}}\n";
static const char wood[] = "materials: [{region: all, youngs_modulus: [1000, 100, 50], density: 2, "
                           "poissons_ratio: {nu12: 0.3, nu23: 0.25, nu13: 0.35}, "
                           "shear_modulus: {G12: 60, G23: 20, G13: 40}}]\n";

static OstCase *c;
static OstExact exact;

static void read_formula(const char *mesh, const char *material, const char *formula, const char *parameters)
{
    char text[4096];
    snprintf(text, sizeof text,
             "%s%sverify: {formula: %s, source: test, parameters: {%s}, ladder: [{order: 1, refinements: [0]}], "
             "quantities: {u: {field: energy, error: [1], rate: [1]}}}\n",
             mesh, material, formula, parameters);
    assert_success(read_text(text, &c));
}

static void make(const char *mesh, const char *material, const char *formula, const char *parameters)
{
    read_formula(mesh, material, formula, parameters);
    assert_success(ost_exact_create(c, &exact));
}

static double value_of(const char *name)
{
    const int value = ost_formula_find_value(exact.formula, name);
    assert_true(value >= 0);
    return exact.data.value[value];
}

/* --- published numbers --- */

static void check_torsion(const char *shear, double published)
{
    char material[256];
    snprintf(material, sizeof material,
             "materials: [{region: all, youngs_modulus: [9, 9, 9], poissons_ratio: {nu12: 0, nu23: 0, nu31: 0}, "
             "shear_modulus: {%s}}]\n",
             shear);
    make(column, material, "torsion", "twist: 0.1");
    assert_close(value_of("torsional_stiffness"), published, 0.5e-7);
    ost_case_destroy(&c);
}

/* Numbers of the issue: T / theta of a 2 × 1 section; the first is also Timoshenko and Goodier's 0.229 × 2. */
static void torsion_of_a_rectangle_is_the_published(void **state)
{
    check_torsion("G12: 1, G23: 1, G31: 1", 0.45736335);
    check_torsion("G12: 1, G23: 5, G31: 1", 0.57271483);
    check_torsion("G12: 1, G23: 1, G31: 5", 1.2501145);
}

/* Lekhnitskii's tube with the constants. */
static void the_orthotropic_tube_is_the_published(void **state)
{
    make(cube,
         "materials: [{region: all, youngs_modulus: [10, 100, 10], "
         "poissons_ratio: {nu12: 0.03, nu23: 0.3, nu13: 0.3}, shear_modulus: {G12: 5, G23: 5, G31: 5}, "
         "axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}]\n",
         "cylinder", "inner_radius: 1, outer_radius: 2, pressure: 1");
    assert_close(value_of("exponent"), 3.030287741, 1e-9);
    assert_close(value_of("inner_displacement"), 0.03484369363, 1e-11);
    assert_close(value_of("outer_displacement"), 0.007463388996, 1e-12);
    assert_close(value_of("inner_hoop_stress"), 3.122471607, 1e-9);
    ost_case_destroy(&c);
}

static double inner_displacement(const char *formula, const char *nu)
{
    char material[128];
    snprintf(material, sizeof material, "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: %s}]\n", nu);
    make(cube, material, formula, "inner_radius: 3, outer_radius: 9, pressure: 1");
    const double value = value_of("inner_displacement");
    ost_case_destroy(&c);
    return value;
}

/* MacNeal and Harder (1985), Finite Elements in Analysis and Design 1, table 9; the numbers. */
static void thick_walls_are_the_published(void **state)
{
    assert_close(inner_displacement("cylinder", "0.49"), 5.039925e-3, 1e-12);
    assert_close(inner_displacement("cylinder", "0.499"), 5.06024925e-3, 1e-12);
    assert_close(inner_displacement("cylinder", "0.4999"), 5.062274992e-3, 1e-12);
    assert_close(inner_displacement("sphere", "0.3"), 2.071153846e-3, 1e-12);
    assert_close(inner_displacement("sphere", "0.4999"), 2.336405769e-3, 1e-12);
}

/* P L³ / 3EI + P L (12 + 11 nu) / (10 (1 + nu)) / (G A), for nu = 0.3 and G = E / 2.6 (Cowper 1966). */
static void an_isotropic_bar_has_cowpers_shear_coefficient(void **state)
{
    make(bar, "materials: [{region: all, youngs_modulus: 13, poissons_ratio: 0.3}]\n", "flexure", "force: 2");
    const double bending = 2.0 * 1000.0 / (3.0 * 13.0 * 0.8 / 12.0);
    const double shear = 2.0 * 10.0 * (12.0 + 3.3) / 13.0 / (5.0 * 0.8);
    assert_close(value_of("tip_deflection"), bending + shear, 1e-12 * bending);
    ost_case_destroy(&c);
}

/* --- the equations --- */

static const char any_body[] = "materials: [{region: all, youngs_modulus: [10, 2, 1], density: 2, "
                               "poissons_ratio: {nu12: 0.3, nu23: 0.35, nu31: 0.04}, "
                               "shear_modulus: {G12: 1.5, G23: 0.6, G31: 2}, "
                               "axes: {cylindrical: {origin: [-9, -5, 0], axis: [1, 2, 5], "
                               "order: [radial, axial, tangential]}}}]\n";

/* The stress of the field, in the case's material, is in balance with `force` per volume at points of the body. */
static void check_balance(const double force[3], double scale)
{
    static const double points[3][3] = {{0.9, 0.31, 0.23}, {0.95, -0.2, 0.36}, {0.85, 0.28, -0.35}};
    for (int p = 0; p < 3; p++) {
        double found[3];
        assert_success(exact.field.body_force(&exact, points[p], found));
        for (int i = 0; i < 3; i++)
            assert_close(found[i], force[i], 1e-9 * scale);
    }
    ost_case_destroy(&c);
}

static void every_solution_is_in_balance_with_its_load(void **state)
{
    const double none[3] = {0.0, 0.0, 0.0};
    make(bar, wood, "flexure", "force: 1");
    check_balance(none, 100.0);
    make(bar, wood, "strip", "force: 1");
    check_balance(none, 100.0);
    make(bar, wood, "bending", "moment: 1");
    check_balance(none, 100.0);
    make(bar,
         "materials: [{region: all, youngs_modulus: [1000, 100, 50], poissons_ratio: {nu12: 0, nu23: 0, nu31: 0}, "
         "shear_modulus: {G12: 60, G23: 20, G13: 40}}]\n",
         "uniform_load", "load: 1.6");
    check_balance((const double[3]){0.0, 0.0, 2.0}, 100.0);
    make(column, wood, "torsion", "twist: 0.1");
    check_balance(none, 10.0);
    make(column, wood, "hanging_bar", "gravity: 10");
    check_balance((const double[3]){0.0, 0.0, -20.0}, 20.0);
    make(cube,
         "materials: [{region: all, youngs_modulus: [10, 100, 10], "
         "poissons_ratio: {nu12: 0.03, nu23: 0.3, nu13: 0.3}, shear_modulus: {G12: 5, G23: 5, G31: 5}, "
         "axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}]\n",
         "cylinder", "inner_radius: 1, outer_radius: 2, pressure: 1");
    check_balance(none, 1.0);
    make(cube, steel, "sphere", "inner_radius: 1, outer_radius: 2, pressure: 1");
    check_balance(none, 1.0);
}

static void stress_at(double x, double y, double z, double stress[6])
{
    const double point[3] = {x, y, z};
    assert_success(exact.field.stress(&exact, point, stress));
}

/* Traction on the sides of a bar, away from the corners where the series is cut. */
static void the_sides_of_a_bent_bar_are_free(void **state)
{
    make(bar, wood, "flexure", "force: 1");
    for (int i = -2; i <= 2; i++) {
        double s[6];
        stress_at(3.0, 0.4, 0.2 * i, s);
        assert_close(fabs(s[1]) + fabs(s[3]) + fabs(s[4]), 0.0, 1e-9);
        stress_at(3.0, 0.16 * i, 0.5, s);
        assert_close(fabs(s[2]) + fabs(s[4]), 0.0, 1e-9);
        assert_close(s[5], 0.0, 2e-4); /* of 1.9 in the middle: the terms left out */
    }
    double s[6];
    stress_at(3.0, 0.1, 0.3, s);
    assert_close(s[0], -7.0 * 0.3 / (0.8 / 12.0), 1e-9); /* -P (L - x) z / I */
    ost_case_destroy(&c);
}

static void the_sides_of_a_twisted_bar_are_free(void **state)
{
    make(column, wood, "torsion", "twist: 0.1");
    for (int i = -2; i <= 2; i++) {
        double s[6];
        stress_at(1.0, 0.2 * i, 1.0, s);
        assert_close(s[5], 0.0, 1e-9);
        stress_at(0.4 * i, 0.5, 1.0, s);
        assert_close(s[4], 0.0, 3e-2); /* of 1.5 in the middle: the terms left out fall slowly on this side */
    }
    ost_case_destroy(&c);
}

static void the_inside_of_a_tube_bears_the_pressure(void **state)
{
    double s[6];
    make(cube, steel, "cylinder", "inner_radius: 1, outer_radius: 2, pressure: 3");
    stress_at(0.0, 1.0, 0.2, s);
    assert_close(s[1], -3.0, 1e-9);
    stress_at(-2.0, 0.0, 0.2, s);
    assert_close(s[0], 0.0, 1e-9);
    ost_case_destroy(&c);
    make(cube, steel, "sphere", "inner_radius: 1, outer_radius: 2, pressure: 3");
    stress_at(0.0, 0.0, 1.0, s);
    assert_close(s[2], -3.0, 1e-9);
    ost_case_destroy(&c);
}

/* Means over the section by the midpoint rule, which is exact enough for a smooth field on 200 × 200 points. */
static void mean_deflection_and_rotation(double x, double *deflection, double *rotation)
{
    enum { N = 200 };
    double moment = 0.0, square = 0.0;
    *deflection = 0.0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double point[3] = {x, 0.8 * ((i + 0.5) / N - 0.5), (j + 0.5) / N - 0.5};
            double u[3];
            assert_success(exact.field.displacement(&exact, point, u));
            *deflection += u[2] / (N * N);
            moment += u[0] * point[2];
            square += point[2] * point[2];
        }
    *rotation = -moment / square;
}

static void the_mean_line_is_timoshenkos(void **state)
{
    static const char *const formula[] = {"flexure", "bending"};
    static const char *const parameter[] = {"force: 1", "moment: 1"};
    for (int f = 0; f < 2; f++) {
        double deflection, rotation;
        make(bar, wood, formula[f], parameter[f]);
        const double tip = value_of("tip_deflection");
        mean_deflection_and_rotation(0.0, &deflection, &rotation);
        assert_close(deflection, 0.0, 2e-6 * tip);
        assert_close(rotation, 0.0, 2e-6 * tip);
        mean_deflection_and_rotation(10.0, &deflection, &rotation);
        assert_close(deflection, tip, 2e-6 * tip);
        ost_case_destroy(&c);
    }
}

/* Differences of eighth order against derivatives by hand, and with another step. */
static void differences_are_good_to_ten_digits(void **state)
{
    const double point[3] = {0.3, 0.7, 0.2};
    double force[3], again[3], by_hand[9], by_differences[9];
    make(cube, any_body, "waves", "amplitude: 0.5, wave_number: 3");
    assert_success(exact.field.body_force(&exact, point, force));
    exact.data.length *= 1.7;
    assert_success(exact.field.body_force(&exact, point, again));
    assert_true(ost_norm3(force) > 1.0);
    for (int i = 0; i < 3; i++)
        assert_close(force[i], again[i], 1e-10 * ost_norm3(force));
    assert_success(exact.field.gradient(&exact, point, by_hand));
    const OstFormula waves = *exact.formula;
    OstFormula without = waves;
    without.gradient = NULL;
    exact.formula = &without;
    assert_success(exact.field.gradient(&exact, point, by_differences));
    for (int i = 0; i < 9; i++)
        assert_close(by_differences[i], by_hand[i], 1e-10);
    ost_case_destroy(&c);
}

/* Of u = (x², ...) the isotropic body force is known: -(lambda + mu) grad div u - mu lap u. */
static void the_force_of_a_polynomial_is_known(void **state)
{
    double found[3];
    make(cube, "materials: [{region: all, youngs_modulus: 2.6, poissons_ratio: 0.3}]\n", "polynomial", "degree: 2");
    const double mu = 1.0, lambda = 2.6 * 0.3 / (1.3 * 0.4);
    /* From the formula's coefficients of x², y², z², xy, yz, zx. */
    const double laplacian[3] = {2 * (0.004 - 0.003 + 0.002), 2 * (-0.002 + 0.006 + 0.001),
                                 2 * (0.003 + 0.001 - 0.005)};
    const double of_dilatation[3] = {2 * 0.004 - 0.003 - 0.004, 0.005 + 2 * 0.006 + 0.003, 0.003 + 0.004 - 2 * 0.005};
    assert_success(exact.field.body_force(&exact, (const double[3]){0.2, 0.4, 0.9}, found));
    for (int i = 0; i < 3; i++)
        assert_close(found[i], -(lambda + mu) * of_dilatation[i] - mu * laplacian[i], 1e-12);
    ost_case_destroy(&c);
}

/* --- refusals --- */

static void refuse(const char *mesh, const char *material, const char *formula, const char *parameters, const char *why)
{
    read_formula(mesh, material, formula, parameters);
    assert_failure(ost_exact_create(c, &exact), OST_INVALID_INPUT, why);
    ost_case_destroy(&c);
}

static void formulas_refuse_what_they_are_not_for(void **state)
{
    refuse(cube, steel, "flexion", "force: 1", "there is no formula 'flexion'; there are: flexure, bending");
    refuse(bar, steel, "flexure", "forces: 1", "wants the parameter 'force'");
    refuse(bar, steel, "flexure", "force: 1, moment: 1", "found 2 parameters");
    refuse(cube, steel, "flexure", "force: 1", "is for a block with its origin at [0, -b/2, -h/2]");
    refuse(bar, any_body, "flexure", "force: 1", "without axes of its own");
    refuse(bar, steel, "uniform_load", "load: 1", "without Poisson's ratios");
    refuse(cube, wood, "sphere", "inner_radius: 1, outer_radius: 2, pressure: 1", "an isotropic material");
    refuse(cube, any_body, "cylinder", "inner_radius: 1, outer_radius: 2, pressure: 1", "cylindrical about the z axis");
    refuse(cube, steel, "polynomial", "degree: 3", "degree 1 or 2");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(torsion_of_a_rectangle_is_the_published),
    cmocka_unit_test(the_orthotropic_tube_is_the_published),
    cmocka_unit_test(thick_walls_are_the_published),
    cmocka_unit_test(an_isotropic_bar_has_cowpers_shear_coefficient),
    cmocka_unit_test(every_solution_is_in_balance_with_its_load),
    cmocka_unit_test(the_sides_of_a_bent_bar_are_free),
    cmocka_unit_test(the_sides_of_a_twisted_bar_are_free),
    cmocka_unit_test(the_inside_of_a_tube_bears_the_pressure),
    cmocka_unit_test(the_mean_line_is_timoshenkos),
    cmocka_unit_test(differences_are_good_to_ten_digits),
    cmocka_unit_test(the_force_of_a_polynomial_is_known),
    cmocka_unit_test(formulas_refuse_what_they_are_not_for),
};

OST_TEST_MAIN(tests)

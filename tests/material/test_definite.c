/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "core/small.h"
#include "material/random.h"
#include "orthostat/material.h"

static OstOrthotropic naive(double e1, double e2, double e3, double nu)
{
    return (OstOrthotropic){{e1, e2, e3}, {nu, nu, nu}, {1, 1, 1}};
}

static OstStatus create(const OstOrthotropic *constants)
{
    OstMaterial material;
    return ost_material_create(ctx, "wood", constants, 1.0, &material);
}

static void the_papers_naive_examples_fail(void **state)
{
    const OstOrthotropic a = naive(1, 1, 4, 0.45), b = naive(1, 1, 10, 0.3);
    assert_failure(create(&a), OST_INVALID_INPUT, "material 'wood' is not stable");
    assert_non_null(strstr(ost_error_text(ctx), "= -0.245375 must be positive")); /* eq. 8 by hand */
    assert_failure(create(&b), OST_INVALID_INPUT, "= -0.053 must be positive");
    const OstOrthotropic stable = naive(1, 1, 9.4, 0.3); /* 1 - nu²(1 + 9.4 + 1/9.4) - 2 nu³ = 0.0004 */
    assert_success(create(&stable));
}

static void a_pair_beyond_its_bound_is_named(void **state)
{
    const OstOrthotropic constants = {{1, 4, 1}, {0.1, 0.1, 1.2}, {1, 1, 1}};
    assert_failure(create(&constants), OST_INVALID_INPUT, "nu31² = 1.44 must be below E3/E1 = 1 (nu13 is 1.2)");
}

/* The three numbers behind `word` in the failure's text: "nu12 = a (nu21 = ...), nu23 = b (...), nu31 = c (...)". */
static void numbers_after(const char *word, double nu[3])
{
    const char *place = strstr(ost_error_text(ctx), word);
    assert_non_null(place);
    place = strstr(place, "nu12 = ");
    assert_non_null(place);
    assert_int_equal(sscanf(place, "nu12 = %lf (%*[^)]), nu23 = %lf (%*[^)]), nu31 = %lf", &nu[0], &nu[1], &nu[2]), 3);
}

static void suggested_values_are_stable_and_the_largest(void **state)
{
    int refused = 0;
    for (int trial = 0; trial < 2000; trial++) {
        OstOrthotropic constants;
        random_moduli(8.0, constants.youngs_modulus);
        random_moduli(2.0, constants.shear_modulus);
        for (int i = 0; i < 3; i++)
            constants.poissons_ratio[i] =
                random_between(-2.0, 2.0) * sqrt(constants.youngs_modulus[i] / constants.youngs_modulus[(i + 1) % 3]);
        if (create(&constants) == OST_SUCCESS)
            continue;
        refused++;
        OstOrthotropic shrunk = constants, family = constants;
        numbers_after("Stable up to", shrunk.poissons_ratio);
        numbers_after("stable family", family.poissons_ratio);
        OstOrthotropic beyond = shrunk;
        for (int i = 0; i < 3; i++)
            beyond.poissons_ratio[i] *= 1.0 + 2e-3; /* the scale is cut to four digits */
        assert_success(create(&shrunk));
        assert_success(create(&family));
        assert_int_equal(create(&beyond), OST_INVALID_INPUT);
    }
    assert_in_range(refused, 1000, 2000);
}

static void family_proposed_keeps_the_nu_that_was_meant(void **state)
{
    const OstOrthotropic a = naive(1, 1, 4, 0.45);
    assert_failure(create(&a), OST_INVALID_INPUT,
                   "nu = 0.45 means nu12 = 0.45 (nu21 = 0.45), nu23 = 0.225 (nu32 = 0.9), nu31 = 0.9 (nu13 = 0.225)");
}

static void family_is_stable_for_all_moduli_and_nu(void **state)
{
    for (int trial = 0; trial < 20000; trial++) {
        double e[3], eigenvalues[3];
        random_moduli(12.0, e);
        const double nu = random_between(-1.0 + 1e-9, 0.5 - 1e-9);
        const OstOrthotropic constants = ost_orthotropic_family(e, nu, (OstShearRule)(trial % 4));
        assert_success(create(&constants));
        assert_success(ost_orthotropic_eigenvalues(ctx, &constants, eigenvalues));
        const double expected[3] = {fmin(1 - 2 * nu, 1 + nu), 1 + nu, fmax(1 - 2 * nu, 1 + nu)};
        for (int i = 0; i < 3; i++)
            assert_close(eigenvalues[i], expected[i], 4e-15);
    }
}

static void family_at_its_ends_is_refused(void **state)
{
    const double e[3] = {1, 10, 1e6}, outside[4] = {0.5 + 1e-12, 0.7, -1.0, -1.3};
    for (int i = 0; i < 4; i++) {
        const OstOrthotropic constants = ost_orthotropic_family(e, outside[i], OST_SHEAR_GEOMETRIC);
        assert_failure(create(&constants), OST_INVALID_INPUT, "-1 < nu <= 0.5");
    }
    const double nearly[2] = {0.4999999, -0.9999999};
    for (int i = 0; i < 2; i++) {
        const OstOrthotropic constants = ost_orthotropic_family(e, nearly[i], OST_SHEAR_GEOMETRIC);
        assert_success(create(&constants));
    }
}

static void bad_numbers_are_refused_by_name_and_value(void **state)
{
    static const char *const names[9] = {"E1", "E2", "E3", "nu12", "nu23", "nu31", "G12", "G23", "G31"};
    const double bad[4] = {NAN, INFINITY, 0.0, -3.0};
    for (int k = 0; k < 9; k++)
        for (int i = 0; i < (k / 3 == 1 ? 2 : 4); i++) {
            OstOrthotropic constants = {{1, 2, 3}, {0.1, 0.2, 0.1}, {1, 1, 1}};
            double *group[3] = {constants.youngs_modulus, constants.poissons_ratio, constants.shear_modulus};
            char expected[64];
            group[k / 3][k % 3] = bad[i];
            snprintf(expected, sizeof expected, "material 'wood': %s = %g", names[k], bad[i]);
            assert_failure(create(&constants), OST_INVALID_INPUT, expected);
        }
    const OstOrthotropic fine = {{1, 2, 3}, {0.1, 0.2, 0.1}, {1, 1, 1}};
    OstMaterial material;
    assert_failure(ost_material_create(ctx, "wood", &fine, -1.0, &material), OST_INVALID_INPUT, "density = -1");
    assert_failure(ost_material_create(ctx, "wood", &fine, NAN, &material), OST_INVALID_INPUT, "density = nan");
}

static void ratios_are_stable_inside_their_range_only(void **state)
{
    int checked = 0;
    for (int trial = 0; trial < 500; trial++) {
        OstOrthotropic constants;
        random_moduli(6.0, constants.youngs_modulus);
        random_moduli(6.0, constants.shear_modulus);
        for (int i = 0; i < 3; i++)
            constants.poissons_ratio[i] =
                random_between(-0.8, 0.8) * sqrt(constants.youngs_modulus[i] / constants.youngs_modulus[(i + 1) % 3]);
        double low[3], high[3];
        ost_orthotropic_stable_range(&constants, low, high);
        for (int i = 0; i < 3; i++) {
            const double width = high[i] - low[i];
            const double inside[2] = {low[i] + 1e-6 * width, high[i] - 1e-6 * width};
            const double outside[2] = {low[i] - 1e-6 * width, high[i] + 1e-6 * width};
            for (int side = 0; side < 2; side++) {
                OstOrthotropic changed = constants;
                changed.poissons_ratio[i] = inside[side];
                assert_success(create(&changed));
                changed.poissons_ratio[i] = outside[side];
                assert_int_equal(create(&changed), OST_INVALID_INPUT);
                checked++;
            }
        }
    }
    assert_int_equal(checked, 3000);
    const OstOrthotropic hopeless = {{1, 1, 1}, {0, 1.5, 0}, {1, 1, 1}};
    double low[3], high[3];
    ost_orthotropic_stable_range(&hopeless, low, high);
    assert_true(isnan(low[0]) && isnan(high[0]));
}

static void scale_meets_the_boundary(void **state)
{
    OstOrthotropic constants = {{3, 1, 20}, {0.2, -0.1, 0.4}, {1, 1, 1}};
    double eigenvalues[3];
    assert_success(ost_orthotropic_eigenvalues(ctx, &constants, eigenvalues));
    const double scale = ost_orthotropic_stable_scale(eigenvalues);
    for (int i = 0; i < 3; i++)
        constants.poissons_ratio[i] *= scale;
    assert_success(ost_orthotropic_eigenvalues(ctx, &constants, eigenvalues));
    assert_close(eigenvalues[0], 0.0, 1e-15);
    const OstOrthotropic none = naive(1, 2, 3, 0.0);
    assert_success(ost_orthotropic_eigenvalues(ctx, &none, eigenvalues));
    assert_true(isinf(ost_orthotropic_stable_scale(eigenvalues)));
}

/* Isotropic and family alike: 0.45 is not above 0.45, but the next number a person would write is. */
static void rounding_decides_no_limit(void **state)
{
    const double e[4][3] = {{1, 1, 1}, {2.1e11, 2.1e11, 2.1e11}, {1, 1000, 1}, {3, 0.7, 1e9}};
    for (int k = 0; k < 4; k++)
        for (int i = 1; i < 500; i++) {
            const double nu = i / 1000.0;
            const OstOrthotropic limit = ost_orthotropic_family(e[k], nu, OST_SHEAR_GEOMETRIC);
            const OstOrthotropic above = ost_orthotropic_family(e[k], nu + 2e-12, OST_SHEAR_GEOMETRIC);
            double eigenvalues[3];
            assert_success(ost_orthotropic_eigenvalues(ctx, &limit, eigenvalues));
            assert_true(ost_equivalent_poisson(eigenvalues[0]) == nu);
            assert_success(ost_orthotropic_eigenvalues(ctx, &above, eigenvalues));
            assert_true(ost_equivalent_poisson(eigenvalues[0]) > nu);
        }
}

static void auxetic_materials_are_welcome(void **state)
{
    const double e[3] = {1, 100, 1e4};
    const OstOrthotropic constants = ost_orthotropic_family(e, -0.7, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    assert_success(ost_material_create(ctx, "foam", &constants, 1.0, &material));
    assert_true(material.stiffness[1] < 0.0 && material.compliance[1] > 0.0);
    double eigenvalues[6];
    assert_success(ost_symmetric_eigen(ctx, 6, material.stiffness, eigenvalues, NULL));
    assert_true(eigenvalues[0] > 0.0);
}

static void naive_boundary_lies_where_equation_16_says(void **state)
{
    enum { COUNT = 36 };
    const double nus[4] = {0.1, 0.3, 0.49, -0.5};
    for (int k = 0; k < 4; k++) {
        double ratios[2 * COUNT];
        const double nu = nus[k];
        assert_success(ost_orthotropic_naive_boundary(ctx, nu, COUNT, ratios));
        for (int i = 0; i < COUNT; i++) {
            const double x = ratios[2 * i], y = ratios[2 * i + 1];
            /* eq. 8 with nu_ji = nu E_j / E_i */
            assert_close(1.0 - nu * nu * (1.0 / x + y + x / y) - 2.0 * nu * nu * nu, 0.0, 1e-12);
        }
    }
    double ratios[2];
    assert_failure(ost_orthotropic_naive_boundary(ctx, 0.5, 1, ratios), OST_INVALID_INPUT, "nu = 0.5");
    assert_failure(ost_orthotropic_naive_boundary(ctx, 0.0, 1, ratios), OST_INVALID_INPUT, "nu = 0");
    assert_failure(ost_orthotropic_naive_boundary(ctx, NAN, 1, ratios), OST_INVALID_INPUT, "nu = nan");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_papers_naive_examples_fail),
    cmocka_unit_test(a_pair_beyond_its_bound_is_named),
    cmocka_unit_test(suggested_values_are_stable_and_the_largest),
    cmocka_unit_test(family_proposed_keeps_the_nu_that_was_meant),
    cmocka_unit_test(family_is_stable_for_all_moduli_and_nu),
    cmocka_unit_test(family_at_its_ends_is_refused),
    cmocka_unit_test(bad_numbers_are_refused_by_name_and_value),
    cmocka_unit_test(ratios_are_stable_inside_their_range_only),
    cmocka_unit_test(scale_meets_the_boundary),
    cmocka_unit_test(rounding_decides_no_limit),
    cmocka_unit_test(auxetic_materials_are_welcome),
    cmocka_unit_test(naive_boundary_lies_where_equation_16_says),
};

OST_TEST_MAIN(tests)

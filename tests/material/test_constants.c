/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "material/random.h"
#include "orthostat/material.h"

enum { TRIALS = 500 };

/* A definite material whose nine constants have nothing to do with each other. */
static OstMaterial random_material(void)
{
    for (;;) {
        OstOrthotropic constants;
        OstMaterial material;
        random_moduli(6.0, constants.youngs_modulus);
        random_moduli(6.0, constants.shear_modulus);
        for (int i = 0; i < 3; i++)
            constants.poissons_ratio[i] =
                random_between(-0.9, 0.9) * sqrt(constants.youngs_modulus[i] / constants.youngs_modulus[(i + 1) % 3]);
        if (ost_material_create(ctx, "random", &constants, 1.0, &material) == OST_SUCCESS && material.condition < 1e3)
            return material;
    }
}

/* S of eq. 4 and C of eq. 5-8, entry by entry as printed in the paper. */
static void paper_matrices(const OstOrthotropic *m, double s[36], double c[36])
{
    const double e1 = m->youngs_modulus[0], e2 = m->youngs_modulus[1], e3 = m->youngs_modulus[2];
    const double nu12 = m->poissons_ratio[0], nu23 = m->poissons_ratio[1], nu31 = m->poissons_ratio[2];
    const double nu21 = nu12 * e2 / e1, nu32 = nu23 * e3 / e2, nu13 = nu31 * e1 / e3;
    const double y = 1.0 / (1.0 - nu12 * nu21 - nu23 * nu32 - nu31 * nu13 - 2.0 * nu21 * nu32 * nu13);
    memset(s, 0, 36 * sizeof *s);
    memset(c, 0, 36 * sizeof *c);
    const double s_n[9] = {1 / e1,     -nu21 / e2, -nu31 / e3, -nu12 / e1, 1 / e2,
                           -nu32 / e3, -nu13 / e1, -nu23 / e2, 1 / e3};
    const double c_n[9] = {e1 * (1 - nu23 * nu32),    e2 * (nu12 + nu32 * nu13), e3 * (nu13 + nu12 * nu23),
                           e1 * (nu21 + nu31 * nu23), e2 * (1 - nu13 * nu31),    e3 * (nu23 + nu21 * nu13),
                           e1 * (nu31 + nu21 * nu32), e2 * (nu32 + nu12 * nu31), e3 * (1 - nu12 * nu21)};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            s[6 * i + j] = s_n[3 * i + j];
            c[6 * i + j] = y * c_n[3 * i + j];
        }
        s[7 * (i + 3)] = 1.0 / m->shear_modulus[i];
        c[7 * (i + 3)] = m->shear_modulus[i];
    }
}

/* Entries may differ by decades; each is measured against the diagonal of its row and column. */
static void assert_matrices_close(const double *a, const double *b, double tolerance)
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            assert_close(a[6 * i + j], b[6 * i + j], tolerance * sqrt(b[7 * i] * b[7 * j]));
}

static void stiffness_and_compliance_are_those_of_equations_4_to_8(void **state)
{
    for (int trial = 0; trial < TRIALS; trial++) {
        const OstMaterial material = random_material();
        double s[36], c[36];
        paper_matrices(&material.constants, s, c);
        assert_matrices_close(material.compliance, s, 1e-14);
        assert_matrices_close(material.stiffness, c, 1e-14 * material.condition * material.condition);
    }
}

static void stiffness_times_compliance_is_identity(void **state)
{
    for (int trial = 0; trial < TRIALS; trial++) {
        const OstMaterial material = random_material();
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++) {
                double product = 0.0;
                for (int k = 0; k < 6; k++)
                    product += material.stiffness[6 * i + k] * material.compliance[6 * k + j];
                product *= sqrt(material.stiffness[7 * j] / material.stiffness[7 * i]);
                assert_close(product, i == j ? 1.0 : 0.0, 1e-14 * material.condition);
            }
    }
}

static void matrices_are_symmetric_to_the_last_bit(void **state)
{
    for (int trial = 0; trial < TRIALS; trial++) {
        const OstMaterial material = random_material();
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < i; j++) {
                assert_true(material.stiffness[6 * i + j] == material.stiffness[6 * j + i]);
                assert_true(material.compliance[6 * i + j] == material.compliance[6 * j + i]);
            }
    }
}

static void either_ratio_of_a_pair_gives_the_same_material(void **state)
{
    for (int trial = 0; trial < TRIALS; trial++) {
        const OstMaterial material = random_material();
        const double *e = material.constants.youngs_modulus;
        double forward[6], backward[6], both[6];
        for (int i = 0; i < 3; i++) {
            /* eq. 14: nu_ij / E_i = nu_ji / E_j */
            both[2 * i] = forward[2 * i] = material.constants.poissons_ratio[i];
            both[2 * i + 1] = backward[2 * i + 1] = forward[2 * i] * e[(i + 1) % 3] / e[i];
            forward[2 * i + 1] = backward[2 * i] = NAN;
        }
        const double *given[3] = {forward, backward, both};
        for (int k = 0; k < 3; k++) {
            OstOrthotropic constants;
            assert_success(
                ost_orthotropic_named(ctx, "test", e, given[k], material.constants.shear_modulus, &constants));
            for (int i = 0; i < 3; i++) {
                const double nu = material.constants.poissons_ratio[i];
                assert_close(constants.poissons_ratio[i], nu, 1e-15 * fabs(nu));
                assert_true(constants.youngs_modulus[i] == e[i]);
                assert_true(constants.shear_modulus[i] == material.constants.shear_modulus[i]);
            }
        }
    }
}

static void named_constants_that_are_missing_or_contradict_are_refused(void **state)
{
    const double e[3] = {1, 2, 4}, g[3] = {1, 1, 1};
    const double none31[6] = {0.1, NAN, 0.1, NAN, NAN, NAN};
    const double contradict[6] = {0.1, 0.1, 0.1, NAN, 0.1, NAN};
    const double fine[6] = {0.1, NAN, 0.1, NAN, NAN, 0.1};
    const double no_g31[3] = {1, 1, NAN}, negative_g12[3] = {-1, 1, 1}, zero_e2[3] = {1, 0, 4};
    OstOrthotropic constants;
    assert_failure(ost_orthotropic_named(ctx, "wood", e, none31, g, &constants), OST_INVALID_INPUT,
                   "wood: neither nu31 nor nu13 is given");
    assert_failure(ost_orthotropic_named(ctx, "wood", e, contradict, g, &constants), OST_INVALID_INPUT,
                   "wood: nu12 = 0.1 and nu21 = 0.1 contradict each other");
    assert_non_null(strstr(ost_error_text(ctx), "asks for nu21 = 0.2"));
    assert_failure(ost_orthotropic_named(ctx, "wood", e, fine, no_g31, &constants), OST_INVALID_INPUT,
                   "wood: G31 is not given");
    assert_failure(ost_orthotropic_named(ctx, "wood", e, fine, negative_g12, &constants), OST_INVALID_INPUT,
                   "wood: G12 = -1");
    assert_failure(ost_orthotropic_named(ctx, "wood", zero_e2, fine, g, &constants), OST_INVALID_INPUT, "wood: E2 = 0");
    assert_success(ost_orthotropic_named(ctx, "wood", e, fine, g, &constants));
}

/* C of the family by eq. 24 and 25, with the means of eq. 22. */
static void family_has_the_stiffness_of_equations_24_and_25(void **state)
{
    for (int trial = 0; trial < TRIALS; trial++) {
        double e[3], expected[36] = {0};
        random_moduli(12.0, e);
        const double nu = random_between(-0.9, 0.45);
        const OstShearRule rule = (OstShearRule)(trial % 4);
        const double factor = 1.0 / ((1.0 + nu) * (1.0 - 2.0 * nu));
        for (int i = 0; i < 3; i++) {
            const int n = (i + 1) % 3;
            const double mean[4] = {sqrt(e[i] * e[n]), (e[i] + e[n]) / 2.0, fmin(e[i], e[n]), fmax(e[i], e[n])};
            for (int j = 0; j < 3; j++)
                expected[6 * i + j] = factor * (i == j ? e[i] * (1.0 - nu) : nu * sqrt(e[i] * e[j]));
            expected[7 * (i + 3)] = mean[rule] / 2.0 / (1.0 + nu);
        }
        const OstOrthotropic constants = ost_orthotropic_family(e, nu, rule);
        OstMaterial material;
        assert_success(ost_material_create(ctx, "family", &constants, 1.0, &material));
        assert_matrices_close(material.stiffness, expected, 1e-13);
    }
}

static void family_obeys_equations_17_to_19_and_23(void **state)
{
    for (int trial = 0; trial < TRIALS; trial++) {
        double e[3], product[3];
        random_moduli(12.0, e);
        const double nu = random_between(-0.9, 0.45);
        const OstOrthotropic m = ost_orthotropic_family(e, nu, OST_SHEAR_GEOMETRIC);
        double triple = 1.0;
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3;
            const double reverse = m.poissons_ratio[i] * e[j] / e[i];
            product[i] = m.poissons_ratio[i] * reverse;
            triple *= reverse;
            assert_close(product[i], nu * nu, 1e-15);
            assert_true(m.poissons_ratio[i] * m.poissons_ratio[i] < e[i] / e[j]);
            /* Huber's formula (23) for nu > 0; sqrt(nu_ij nu_ji) = |nu| */
            const double huber = sqrt(e[i] * e[j]) / (2.0 * (1.0 + copysign(sqrt(product[i]), nu)));
            assert_close(m.shear_modulus[i], huber, 1e-13 * huber);
        }
        const double inverse = 1.0 - product[0] - product[1] - product[2] - 2.0 * triple;
        assert_close(inverse, (1.0 + nu) * (1.0 + nu) * (1.0 - 2.0 * nu), 1e-14);
    }
}

static void equal_moduli_make_the_family_isotropic(void **state)
{
    const double e[3] = {7e9, 7e9, 7e9};
    for (OstShearRule rule = OST_SHEAR_GEOMETRIC; rule <= OST_SHEAR_MAX; rule++) {
        const OstOrthotropic family = ost_orthotropic_family(e, 0.3, rule);
        const OstOrthotropic body = ost_orthotropic_isotropic(7e9, 0.3);
        OstMaterial a, b;
        assert_success(ost_material_create(ctx, "family", &family, 1.0, &a));
        assert_success(ost_material_create(ctx, "body", &body, 1.0, &b));
        assert_true(a.isotropic && b.isotropic);
        assert_matrices_close(a.stiffness, b.stiffness, 1e-15);
    }
}

static void isotropic_stiffness_is_lames(void **state)
{
    const double e = 2.1e11, nu = 0.28;
    const double lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = e / (2.0 * (1.0 + nu));
    const OstOrthotropic body = ost_orthotropic_isotropic(e, nu);
    OstMaterial material;
    assert_success(ost_material_create(ctx, "steel", &body, 7850.0, &material));
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            const double normal = i < 3 && j < 3 ? lambda : 0.0;
            const double diagonal = i == j ? (i < 3 ? 2.0 * mu : mu) : 0.0;
            assert_close(material.stiffness[6 * i + j], normal + diagonal, 1e-14 * e);
        }
    assert_string_equal(material.name, "steel");
    assert_close(material.density, 7850.0, 0.0);
    assert_close(material.condition, (1.0 + nu) / (1.0 - 2.0 * nu), 1e-14);
}

static void only_isotropic_constants_are_called_isotropic(void **state)
{
    for (int changed = 0; changed < 9; changed++) {
        OstOrthotropic constants = ost_orthotropic_isotropic(1e6, 0.3);
        double *values[9] = {&constants.youngs_modulus[0], &constants.youngs_modulus[1], &constants.youngs_modulus[2],
                             &constants.poissons_ratio[0], &constants.poissons_ratio[1], &constants.poissons_ratio[2],
                             &constants.shear_modulus[0],  &constants.shear_modulus[1],  &constants.shear_modulus[2]};
        OstMaterial material;
        *values[changed] *= 1.0 + 2e-16;
        assert_success(ost_material_create(ctx, "nearly", &constants, 1.0, &material));
        assert_true(material.isotropic);
        *values[changed] *= 1.0 + 1e-9;
        assert_success(ost_material_create(ctx, "not", &constants, 1.0, &material));
        assert_false(material.isotropic);
    }
}

static void transverse_constants_follow_section_3_1(void **state)
{
    const double ep = 2.0, ez = 50.0, nu_p = 0.25;
    OstOrthotropic m = ost_orthotropic_transverse(ep, ez, nu_p, 0.01, 3.0);
    const double expected[9] = {ep, ep, ez, nu_p, 0.01, 0.01 * ez / ep, ep / (2.0 * (1.0 + nu_p)), 3.0, 3.0};
    for (int i = 0; i < 3; i++) {
        assert_close(m.youngs_modulus[i], expected[i], 0.0);
        assert_close(m.poissons_ratio[i], expected[3 + i], 1e-16);
        assert_close(m.shear_modulus[i], expected[6 + i], 1e-16);
    }
    m = ost_orthotropic_transverse(ep, ez, nu_p, NAN, NAN);
    assert_close(m.poissons_ratio[1], nu_p * sqrt(ep / ez), 1e-16);                /* nu_pz, eq. 20 */
    assert_close(m.poissons_ratio[2], nu_p * sqrt(ez / ep), 1e-15);                /* nu_zp */
    assert_close(m.shear_modulus[1], sqrt(ep * ez) / (2.0 * (1.0 + nu_p)), 1e-15); /* eq. 22 */
    assert_close(m.shear_modulus[1], m.shear_modulus[2], 1e-15);
}

static void words_name_the_axis_of_each_modulus(void **state)
{
    char text[OST_MODULI_WORDS];
    OstOrthotropic constants = ost_orthotropic_transverse(1.0, 88.0, 0.3, NAN, NAN);
    ost_orthotropic_words(&constants, text);
    assert_string_equal(text, "E = 88 along e3 (the axis), 1 along e1 and e2");
    constants.shear_modulus[0] *= 1.1; /* the plane is no longer isotropic */
    ost_orthotropic_words(&constants, text);
    assert_string_equal(text, "E = 88 along e3, 1 along e1 and e2");
    constants = ost_orthotropic_family((const double[3]){2.0, 5.0, 2.0}, 0.3, OST_SHEAR_GEOMETRIC);
    ost_orthotropic_words(&constants, text);
    assert_string_equal(text, "E = 5 along e2 (the axis), 2 along e1 and e3");
    constants = ost_orthotropic_family((const double[3]){7.0, 5.0, 5.0}, 0.3, OST_SHEAR_GEOMETRIC);
    ost_orthotropic_words(&constants, text);
    assert_string_equal(text, "E = 7 along e1 (the axis), 5 along e2 and e3");
    constants = ost_orthotropic_family((const double[3]){1.0, 5.0, 2e11}, 0.3, OST_SHEAR_GEOMETRIC);
    ost_orthotropic_words(&constants, text);
    assert_string_equal(text, "E = 1 along e1, 5 along e2, 2e+11 along e3");
    constants = ost_orthotropic_isotropic(3.0, 0.3);
    ost_orthotropic_words(&constants, text);
    assert_string_equal(text, "E = 3 along e1, e2 and e3");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(words_name_the_axis_of_each_modulus),
    cmocka_unit_test(stiffness_and_compliance_are_those_of_equations_4_to_8),
    cmocka_unit_test(stiffness_times_compliance_is_identity),
    cmocka_unit_test(matrices_are_symmetric_to_the_last_bit),
    cmocka_unit_test(either_ratio_of_a_pair_gives_the_same_material),
    cmocka_unit_test(named_constants_that_are_missing_or_contradict_are_refused),
    cmocka_unit_test(family_has_the_stiffness_of_equations_24_and_25),
    cmocka_unit_test(family_obeys_equations_17_to_19_and_23),
    cmocka_unit_test(equal_moduli_make_the_family_isotropic),
    cmocka_unit_test(isotropic_stiffness_is_lames),
    cmocka_unit_test(only_isotropic_constants_are_called_isotropic),
    cmocka_unit_test(transverse_constants_follow_section_3_1),
};

OST_TEST_MAIN(tests)

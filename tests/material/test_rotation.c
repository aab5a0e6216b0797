/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "material/random.h"
#include "orthostat/material.h"

/* Rows and columns of the 6×6 as pairs of indices: 11 22 33 12 23 31. */
static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

static OstMaterial make(const OstOrthotropic *constants)
{
    OstMaterial material;
    assert_success(ost_material_create(ctx, "test", constants, 1.0, &material));
    return material;
}

static OstMaterial wood(void)
{
    const OstOrthotropic constants = {{10.0, 0.8, 0.5}, {0.35, 0.45, 0.02}, {0.7, 0.1, 0.6}};
    return make(&constants);
}

static double largest(const double matrix[36])
{
    double value = 0.0;
    for (int i = 0; i < 36; i++)
        value = fmax(value, fabs(matrix[i]));
    return value;
}

static void assert_matrices_close(const double a[36], const double b[36], double tolerance)
{
    for (int i = 0; i < 36; i++)
        assert_close(a[i], b[i], tolerance * largest(b));
}

/* C'_ijkl = Q_ip Q_jq Q_kr Q_ls C_pqrs with Q's columns the axes, by the 81 components. */
static void rotate_fourth_order(const double c[36], const double axes[9], double rotated[36])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int a = 0; a < 6; a++)
        for (int b = 0; b < 6; b++) {
            double sum = 0.0;
            for (int m = 0; m < 81; m++) {
                const int p = m / 27, q = m / 9 % 3, r = m / 3 % 3, s = m % 3;
                sum += axes[3 * p + pair[a][0]] * axes[3 * q + pair[a][1]] * axes[3 * r + pair[b][0]] *
                       axes[3 * s + pair[b][1]] * c[6 * place[p][q] + place[r][s]];
            }
            rotated[6 * a + b] = sum;
        }
}

static void rotation_is_that_of_the_fourth_order_tensor(void **state)
{
    const OstMaterial material = wood();
    for (int trial = 0; trial < 100; trial++) {
        double axes[9], expected[36], rotated[36], again[36];
        random_axes(axes);
        rotate_fourth_order(material.stiffness, axes, expected);
        ost_material_rotate_stiffness(material.stiffness, axes, rotated);
        assert_matrices_close(rotated, expected, 1e-14);
        /* a full 6×6: turn what is turned already */
        rotate_fourth_order(rotated, axes, expected);
        ost_material_rotate_stiffness(rotated, axes, again);
        assert_matrices_close(again, expected, 1e-14);
    }
}

static void isotropic_constants_look_the_same_from_everywhere(void **state)
{
    const OstOrthotropic body = ost_orthotropic_isotropic(3e7, 0.4);
    const OstMaterial material = make(&body);
    for (int trial = 0; trial < 100; trial++) {
        double axes[9], rotated[36];
        random_axes(axes);
        ost_material_rotate_stiffness(material.stiffness, axes, rotated);
        assert_matrices_close(rotated, material.stiffness, 1e-14);
        ost_material_rotate_compliance(material.compliance, axes, rotated);
        assert_matrices_close(rotated, material.compliance, 1e-14);
    }
}

/* C_world = K C K^T: K takes stress from material to world axes, K^T strain (with 2 e_ij) from world to material. */
static void k_of_equation_9_turns_stresses_as_tensors_turn(void **state)
{
    const OstMaterial material = wood();
    for (int trial = 0; trial < 100; trial++) {
        double axes[9], rotated[36], strain[9], local_strain[9] = {0};
        random_axes(axes);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j <= i; j++)
                strain[3 * i + j] = strain[3 * j + i] = random_between(-1.0, 1.0);
        for (int m = 0; m < 81; m++) { /* local = axes strain axes^T */
            const int i = m / 27, j = m / 9 % 3, k = m / 3 % 3, l = m % 3;
            local_strain[3 * i + j] += axes[3 * i + k] * strain[3 * k + l] * axes[3 * j + l];
        }
        double local_stress[9] = {0}, stress[9] = {0};
        for (int a = 0; a < 6; a++) {
            double sum = 0.0;
            for (int b = 0; b < 6; b++)
                sum += material.stiffness[6 * a + b] * (b < 3 ? 1.0 : 2.0) * local_strain[3 * pair[b][0] + pair[b][1]];
            local_stress[3 * pair[a][0] + pair[a][1]] = local_stress[3 * pair[a][1] + pair[a][0]] = sum;
        }
        for (int m = 0; m < 81; m++) { /* world = axes^T local axes */
            const int i = m / 27, j = m / 9 % 3, k = m / 3 % 3, l = m % 3;
            stress[3 * i + j] += axes[3 * k + i] * local_stress[3 * k + l] * axes[3 * l + j];
        }
        ost_material_rotate_stiffness(material.stiffness, axes, rotated);
        for (int a = 0; a < 6; a++) {
            double sum = 0.0;
            for (int b = 0; b < 6; b++)
                sum += rotated[6 * a + b] * (b < 3 ? 1.0 : 2.0) * strain[3 * pair[b][0] + pair[b][1]];
            assert_close(sum, stress[3 * pair[a][0] + pair[a][1]], 1e-13 * largest(rotated));
        }
    }
}

static void rotated_compliance_inverts_rotated_stiffness(void **state)
{
    const OstMaterial material = wood();
    for (int trial = 0; trial < 100; trial++) {
        double axes[9], c[36], s[36];
        random_axes(axes);
        ost_material_rotate_stiffness(material.stiffness, axes, c);
        ost_material_rotate_compliance(material.compliance, axes, s);
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++) {
                double product = 0.0;
                for (int k = 0; k < 6; k++)
                    product += c[6 * i + k] * s[6 * k + j];
                assert_close(product, i == j ? 1.0 : 0.0, 1e-13 * largest(c) * largest(s));
            }
    }
}

/* Renaming axes 1, 2, 3 renames the constants and nothing else: world axis 1 is e2, 2 is e3, 3 is e1. */
static void cyclic_axes_permute_the_entries(void **state)
{
    const OstMaterial material = wood();
    const double axes[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double rotated[36];
    ost_material_rotate_stiffness(material.stiffness, axes, rotated);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            const int from_i = i < 3 ? (i + 1) % 3 : 3 + (i - 2) % 3, from_j = j < 3 ? (j + 1) % 3 : 3 + (j - 2) % 3;
            assert_close(rotated[6 * i + j], material.stiffness[6 * from_i + from_j], 0.0);
        }
}

/* A lamina pulled off-axis: 1/Ex = c⁴/E1 + (1/G12 - 2 nu12/E1) c² s² + s⁴/E2, the textbook formula. */
static void off_axis_modulus_is_the_textbooks(void **state)
{
    const OstOrthotropic lamina = {{140, 10, 10}, {0.3, 0.3, 0.3 * 10 / 140}, {5, 10 / 2.6, 5}};
    const OstMaterial material = make(&lamina);
    const double degrees[2] = {30, 45}, expected[2] = {21.292776, 13.207547};
    for (int i = 0; i < 2; i++) {
        const double angle[3] = {degrees[i], 0, 0};
        double axes[9], rotated[36];
        assert_success(ost_axes_from_euler(ctx, "zxz", angle, axes));
        ost_material_rotate_compliance(material.compliance, axes, rotated);
        assert_close(1.0 / rotated[0], expected[i], 5e-7);
        const double c = cos(degrees[i] * M_PI / 180), s = sin(degrees[i] * M_PI / 180);
        const double formula = pow(c, 4) / 140 + (1.0 / 5 - 0.6 / 140) * c * c * s * s + pow(s, 4) / 10;
        assert_close(rotated[0], formula, 1e-15);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rotation_is_that_of_the_fourth_order_tensor),
    cmocka_unit_test(isotropic_constants_look_the_same_from_everywhere),
    cmocka_unit_test(k_of_equation_9_turns_stresses_as_tensors_turn),
    cmocka_unit_test(rotated_compliance_inverts_rotated_stiffness),
    cmocka_unit_test(cyclic_axes_permute_the_entries),
    cmocka_unit_test(off_axis_modulus_is_the_textbooks),
};

OST_TEST_MAIN(tests)

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "element/polar.h"
#include "element_support.h"

/* F from its polar decomposition, whose parts have their properties; of F that is 0 or flat too. */
static void the_polar_decomposition_gives_f_again(void **state)
{
    static const double stretches[6][4][3] = {
        {{1.1, 1.2, 0.3}, {1.0, 1.0, 1.0}, {2.0, 2.0, 0.1}, {0.1, 1.0, 10.0}},
        {{1.1, 1.2, -0.3}, {1.0, 1.0, -0.9}, {2.0, 2.0, -0.1}, {5.0, 4.0, -3.0}},
        {{1.1, 1.2, 0.0}, {1.0, 1.0, 0.0}, {2.0, 1e-9, 1e-9}, {1.0, 1e-9, 0.0}},
        {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1e-20, 0.0, 0.0}, {1e-3, 0.0, 0.0}},
        {{1.0, 1.0, -1.0}, {0.5, 0.5, -0.5}, {2.0, 1.0, -1.0}, {1e-9, 1e-9, -1e-9}},
        {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0 + 1e-9}, {1.0 + 1e-12, 1.0, 1.0}, {1.0, 2.0, 2.0}}};
    for (int s = 0; s < 6; s++) {
        OstSimd slope[9], rotation[9];
        OstPolar polar;
        double f[OST_SIMD_WIDTH][9];
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            deformation(20u + (unsigned)slot, stretches[s][slot % 4], f[slot]);
            for (int n = 0; n < 9; n++)
                slope[n][slot] = f[slot][n] - (n % 4 == 0);
        }
        ost_polar(slope, &polar);
        ost_polar_rotation(&polar, rotation);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double r[9], again[9] = {0.0}, unit[2][9];
            const double size = fmax(1.0, largest_of(9, f[slot]));
            /* Stretches below 1e-8 of the largest are rounding errors in F'F, and so are their directions. */
            const double small = stretches[s][slot % 4][1] < 1e-8 ? 1e-8 : 0.0;
            for (int n = 0; n < 9; n++) {
                double v[3][3], a[3][3];
                for (int k = 0; k < 9; k++) {
                    v[k / 3][k % 3] = polar.before[k][slot];
                    a[k / 3][k % 3] = polar.after[k][slot];
                }
                r[n] = rotation[n][slot];
                for (int k = 0; k < 3; k++)
                    again[n] += polar.stretch[k][slot] * a[k][n / 3] * v[k][n % 3];
                assert_close(again[n], f[slot][n], 1e-13 * size + small);
            }
            ost_multiply3_transposed_left(r, r, unit[0]);
            for (int n = 0; n < 9; n++)
                assert_close(unit[0][n], n % 4 == 0, 1e-14);
            assert_close(ost_determinant3(r), 1.0, 1e-14);
            for (int k = 0; k < 3; k++)
                assert_close(polar.stretch[k][slot], 1.0 + polar.strain[k][slot], 1e-15 * size);
            assert_true(polar.stretch[0][slot] >= polar.stretch[1][slot] - 1e-14 * size);
            assert_true(polar.stretch[1][slot] >= fabs(polar.stretch[2][slot]) - 1e-14 * size);
            const double determinant = ost_determinant3(f[slot]);
            if (fabs(determinant) > 1e-12)
                assert_true((polar.stretch[2][slot] > 0.0) == (determinant > 0.0));
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_polar_decomposition_gives_f_again),
};

OST_TEST_MAIN(tests)

/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/eigen_batch.h"
#include "element_support.h"

enum { N = 9 };

/* Eigenvalues, those of a batch at once: distinct, equal, of very different sizes, and none but 0. */
static const double wanted[][N] = {
    {1, 2, 3, 4, 5, 6, 7, 8, 9}, {-1, -1, -1, 0, 0, 0, 2, 2, 2}, {1e-12, 1e-8, 1e-4, 1, 1e3, -1, -1e-6, 0, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, 0}, {1e9, 1, 1, 1, 1, 1, 1, 1, -1}, {1, -1, 1, -1, 1, -1, 1, -1, 1},
    {0, 0, 0, 0, 5, 0, 0, 0, 0}, {3, 3, 3, 3, 3, 3, 3, 3, 3}};
enum { COUNT = sizeof wanted / sizeof *wanted }; /* a multiple of any SIMD width */

/* Eigenvectors as far from the axes as `mixed` says: those of a diagonal matrix, of one that falls apart into blocks,
 * of a full one. */
static void make_matrix(const double value[N], int mixed, double a[N * N])
{
    unsigned seed = 3u;
    memset(a, 0, N * N * sizeof *a);
    for (int i = 0; i < N; i++)
        a[(N + 1) * i] = value[i];
    for (int p = 0; p < N && mixed; p++)
        for (int q = p + 1; q < N; q += mixed) {
            const double angle = 3.0 * random_number(&seed), c = cos(angle), s = sin(angle);
            for (int side = 0; side < 2; side++)
                for (int i = 0; i < N; i++) {
                    double *x = side ? &a[N * p + i] : &a[N * i + p], *y = side ? &a[N * q + i] : &a[N * i + q];
                    const double kept = *x;
                    *x = c * kept - s * *y;
                    *y = s * kept + c * *y;
                }
        }
}

static void eigenvectors_give_the_matrix_again(void **state)
{
    for (int group = 0; group < COUNT / OST_SIMD_WIDTH; group++)
        for (int mixed = 0; mixed < 5; mixed++) {
            double a[OST_SIMD_WIDTH][N * N];
            OstSimd matrix[N * N], value[N], vectors[N * N];
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
                make_matrix(wanted[OST_SIMD_WIDTH * group + slot], mixed, a[slot]);
                for (int n = 0; n < N * N; n++)
                    matrix[n][slot] = a[slot][n];
            }
            ost_simd_eigen(N, matrix, value, vectors);
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                for (int i = 0; i < N; i++)
                    for (int j = 0; j < N; j++) {
                        double again = 0.0, unit = 0.0;
                        for (int k = 0; k < N; k++) {
                            again += value[k][slot] * vectors[N * k + i][slot] * vectors[N * k + j][slot];
                            unit += vectors[N * i + k][slot] * vectors[N * j + k][slot];
                        }
                        assert_close(again, a[slot][N * i + j],
                                     1e-14 * largest_of(N, wanted[OST_SIMD_WIDTH * group + slot]) + 1e-100);
                        assert_close(unit, i == j, 1e-14);
                    }
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(eigenvectors_give_the_matrix_again),
};

OST_TEST_MAIN(tests)

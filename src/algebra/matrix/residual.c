/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/residual.h"

#include "core/error.h"

#include <math.h>

/* The unevaluated sum of two numbers. */
typedef struct Sum {
    double high, low;
} Sum;

/* sum -= a b; `low` collects the rounding errors of the product and of the addition. */
static inline void subtract_product(Sum *sum, double a, double b)
{
    const double product = -a * b;
    const double product_error = fma(-a, b, -product);
    const double high = sum->high + product;
    const double part = high - sum->high;
    sum->low += (sum->high - (high - part)) + (product - part) + product_error;
    sum->high = high;
}

OstStatus ost_compensated_residual(const OstBlockMatrix *matrix, const double *f, double *u, double *residual)
{
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), u));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        Sum sum[3];
        for (int i = 0; i < 3; i++)
            sum[i] = (Sum){f[3 * (size_t)row + (size_t)i], 0.0};
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
            const double *block = matrix->value + 9 * (size_t)k;
            const double *x = u + 3 * (size_t)matrix->column[k];
            for (int j = 0; j < 3; j++)
                for (int i = 0; i < 3; i++)
                    subtract_product(&sum[i], block[3 * i + j], x[j]);
        }
        for (int i = 0; i < 3; i++)
            residual[3 * (size_t)row + (size_t)i] = sum[i].high + sum[i].low;
    }
    return OST_SUCCESS;
}

OstStatus ost_residual(const OstBlockMatrix *matrix, const double *f, double *u, int compensated, double *residual)
{
    if (compensated)
        return ost_compensated_residual(matrix, f, u, residual);
    OST_TRY(ost_block_matrix_apply(matrix, u, residual));
    for (size_t i = 0; i < 3 * (size_t)matrix->rows; i++)
        residual[i] = f[i] - residual[i];
    return OST_SUCCESS;
}

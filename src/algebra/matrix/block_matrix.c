/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/block_matrix.h"

#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

void ost_block_matrix_destroy(OstBlockMatrix **matrix)
{
    if (!*matrix)
        return;
    OST_FREE((*matrix)->label);
    OST_FREE((*matrix)->row_start);
    OST_FREE((*matrix)->column);
    OST_FREE((*matrix)->diagonal);
    OST_FREE((*matrix)->value);
    OST_FREE((*matrix)->upper);
    OST_FREE((*matrix)->mirror);
    ost_halo_destroy(&(*matrix)->halo);
    OST_FREE(*matrix);
}

/* Each block right of the diagonal acts on its row and, transposed, on the row of its column, if this rank has it. */
OST_KERNEL static void multiply_folded(const OstBlockMatrix *matrix, const double *restrict x, double *restrict y)
{
    const OstLocal *restrict column = matrix->column;
    memset(y, 0, 3 * (size_t)matrix->rows * sizeof *y);
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const OstLocal end = matrix->row_start[i + 1];
        const double *restrict a = matrix->value + 9 * (size_t)matrix->upper[i];
        const double x0 = x[3 * (size_t)i], x1 = x[3 * (size_t)i + 1], x2 = x[3 * (size_t)i + 2];
        double y0 = a[0] * x0 + a[1] * x1 + a[2] * x2;
        double y1 = a[3] * x0 + a[4] * x1 + a[5] * x2;
        double y2 = a[6] * x0 + a[7] * x1 + a[8] * x2;
        OstLocal k = matrix->diagonal[i] + 1;
        for (a += 9; k < end && column[k] < matrix->rows; k++, a += 9) {
            const size_t j = 3 * (size_t)column[k];
            y0 += a[0] * x[j] + a[1] * x[j + 1] + a[2] * x[j + 2];
            y1 += a[3] * x[j] + a[4] * x[j + 1] + a[5] * x[j + 2];
            y2 += a[6] * x[j] + a[7] * x[j + 1] + a[8] * x[j + 2];
            y[j] += a[0] * x0 + a[3] * x1 + a[6] * x2;
            y[j + 1] += a[1] * x0 + a[4] * x1 + a[7] * x2;
            y[j + 2] += a[2] * x0 + a[5] * x1 + a[8] * x2;
        }
        for (; k < end; k++, a += 9) {
            const size_t j = 3 * (size_t)column[k];
            y0 += a[0] * x[j] + a[1] * x[j + 1] + a[2] * x[j + 2];
            y1 += a[3] * x[j] + a[4] * x[j + 1] + a[5] * x[j + 2];
            y2 += a[6] * x[j] + a[7] * x[j + 1] + a[8] * x[j + 2];
        }
        y[3 * (size_t)i] += y0;
        y[3 * (size_t)i + 1] += y1;
        y[3 * (size_t)i + 2] += y2;
    }
}

OST_KERNEL static void multiply_rows(const OstBlockMatrix *matrix, const double *restrict x, double *restrict y)
{
    const OstLocal *restrict column = matrix->column;
    for (OstLocal i = 0; i < matrix->rows; i++) {
        double y0 = 0.0, y1 = 0.0, y2 = 0.0;
        const OstLocal end = matrix->row_start[i + 1];
        const double *restrict a = matrix->value + 9 * (size_t)matrix->row_start[i];
        for (OstLocal k = matrix->row_start[i]; k < end; k++, a += 9) {
            const double *b = x + 3 * (size_t)column[k];
            y0 += a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            y1 += a[3] * b[0] + a[4] * b[1] + a[5] * b[2];
            y2 += a[6] * b[0] + a[7] * b[1] + a[8] * b[2];
        }
        y[3 * (size_t)i] = y0;
        y[3 * (size_t)i + 1] = y1;
        y[3 * (size_t)i + 2] = y2;
    }
}

void ost_block_matrix_multiply(const OstBlockMatrix *matrix, const double *x, double *y)
{
    if (matrix->upper)
        multiply_folded(matrix, x, y);
    else
        multiply_rows(matrix, x, y);
    ost_ledger_multiplied(matrix->ctx, 9.0 * matrix->row_start[matrix->rows]);
}

OstStatus ost_block_matrix_apply(const OstBlockMatrix *matrix, double *x, double *y)
{
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof *x, x));
    ost_block_matrix_multiply(matrix, x, y);
    return OST_SUCCESS;
}

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

OST_KERNEL OstStatus ost_compensated_residual(const OstBlockMatrix *matrix, const double *f, double *u,
                                              double *residual)
{
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), u));
    ost_ledger_multiplied(matrix->ctx, 10.0 * 9.0 * matrix->row_start[matrix->rows]);
    for (OstLocal row = 0; row < matrix->rows; row++) {
        Sum sum[3];
        for (int i = 0; i < 3; i++)
            sum[i] = (Sum){f[3 * (size_t)row + (size_t)i], 0.0};
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
            double room[9];
            const double *block = ost_block_matrix_block(matrix, row, k, room);
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

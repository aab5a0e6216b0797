/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/block_matrix.h"

#include "algebra/matrix/columns.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/together/together.h"

#include <math.h>
#include <string.h>

void ost_block_matrix_destroy(OstBlockMatrix **matrix)
{
    if (!*matrix)
        return;
    OST_FREE((*matrix)->label, (*matrix)->row_start, (*matrix)->column, (*matrix)->diagonal, (*matrix)->value,
             (*matrix)->upper, (*matrix)->mirror);
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

/* A vector, with room for ghosts, and its product. */
typedef struct Product {
    double *x, *y;
} Product;

static OstStatus apply_one(const OstBlockMatrix *matrix, const Product *product)
{
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), product->x));
    ost_block_matrix_multiply(matrix, product->x, product->y);
    return OST_SUCCESS;
}

/* As multiply_rows and multiply_folded, by halves of x and y; y is 0. */
OST_KERNEL static void multiply_columns(const OstBlockMatrix *matrix, const OstHalfColumns *restrict x,
                                        OstHalfColumns *restrict y)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const OstHalfColumns *own = x + 6 * (size_t)i;
        const OstLocal first = matrix->upper ? matrix->diagonal[i] : matrix->row_start[i];
        const double *a = matrix->value + 9 * (size_t)(matrix->upper ? matrix->upper[i] : first);
        OstHalfColumns sum[6] = {{0}};
        for (OstLocal k = first; k < matrix->row_start[i + 1]; k++, a += 9) {
            const OstLocal j = matrix->column[k];
            const OstHalfColumns *b = x + 6 * (size_t)j;
            OstHalfColumns *there = y + 6 * (size_t)j;
            for (int h = 0; h < 2; h++)
                for (int r = 0; r < 3; r++)
                    sum[2 * r + h] += a[3 * r] * b[h] + a[3 * r + 1] * b[2 + h] + a[3 * r + 2] * b[4 + h];
            if (!matrix->upper || j == i || j >= matrix->rows)
                continue;
            for (int h = 0; h < 2; h++)
                for (int c = 0; c < 3; c++)
                    there[2 * c + h] += a[c] * own[h] + a[3 + c] * own[2 + h] + a[6 + c] * own[4 + h];
        }
        for (int r = 0; r < 6; r++)
            y[6 * (size_t)i + (size_t)r] += sum[r];
    }
    ost_ledger_multiplied(matrix->ctx, 9.0 * matrix->row_start[matrix->rows]);
}

static OstStatus apply_columns(const OstBlockMatrix *matrix, int count, const double *const *x, double *const *y)
{
    const size_t n = 3 * (size_t)matrix->rows;
    double *columns = NULL;
    OST_TRY(ost_agree(matrix->ctx,
                      OST_NEW_UNCLEARED(matrix->ctx, &columns, OST_COLUMNS * (n + 3 * (size_t)matrix->columns))));
    double *products = columns + 3 * OST_COLUMNS * (size_t)matrix->columns;
    memset(products, 0, OST_COLUMNS * n * sizeof *products);
    ost_columns_pack(n, count, x, columns);
    const OstStatus status = ost_halo_import(matrix->halo, 3 * sizeof(OstColumns), columns);
    if (status == OST_SUCCESS) {
        multiply_columns(matrix, (const OstHalfColumns *)columns, (OstHalfColumns *)products);
        ost_columns_unpack(n, count, products, y);
    }
    OST_FREE(columns);
    return status;
}

/* OstServe. */
static OstStatus apply_all(void *common, int count, void *const *request)
{
    const double *x[OST_MOST_TOGETHER];
    double *y[OST_MOST_TOGETHER];
    for (int k = 0; k < count; k++) {
        x[k] = ((const Product *)request[k])->x;
        y[k] = ((const Product *)request[k])->y;
    }
    for (int k = 0, next = 1; k < count; k += next) {
        next = ost_columns_next(count - k);
        OST_TRY(next > 1 ? apply_columns(common, next, x + k, y + k) : apply_one(common, request[k]));
    }
    return OST_SUCCESS;
}

OstStatus ost_block_matrix_apply(const OstBlockMatrix *matrix, double *x, double *y)
{
    Product product = {x, y};
    return ost_together(matrix->ctx, apply_all, OST_COLUMNS, (void *)matrix, &product);
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

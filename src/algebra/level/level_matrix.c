/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/level_matrix.h"

#include "algebra/level/simd.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"

void ost_level_matrix_destroy(OstLevelMatrix **matrix)
{
    if (!*matrix)
        return;
    OST_FREE((*matrix)->row_start, (*matrix)->own_end, (*matrix)->column, (*matrix)->diagonal, (*matrix)->value,
             (*matrix)->diagonal_rest, (*matrix)->value_rest);
    ost_exchange_destroy(&(*matrix)->exchange);
    OST_FREE(*matrix);
}

static void round_block(size_t count, const double *source, float *rounded)
{
    for (size_t k = 0; k < count; k++)
        rounded[k] = (float)source[k];
}

OST_UNROLLED void fill_upper_half(const OstDoubleMatrix *source, int size, OstLevelMatrix *matrix)
{
    const size_t square = (size_t)(size * size);
    OstLocal upper = 0;
    double room[OST_BLOCK];
    for (OstLocal i = 0; i < source->rows; i++) {
        matrix->own_end[i] = upper;
        for (OstLocal k = source->row_start[i]; k < source->row_start[i + 1]; k++) {
            if (source->column[k] < i)
                continue;
            const double *block = ost_double_matrix_block(source, size, i, k, room);
            if (source->column[k] == i) {
                round_block(square, block, matrix->diagonal + square * (size_t)i);
                continue;
            }
            round_block(square, block, matrix->value + square * (size_t)upper);
            matrix->column[upper++] = source->column[k];
            if (source->column[k] < source->rows)
                matrix->own_end[i] = upper;
        }
        matrix->row_start[i + 1] = upper;
    }
}

OST_KERNEL static OstStatus copy_upper_half(const OstDoubleMatrix *source, OstLevelMatrix *matrix)
{
    OstContext *ctx = source->ctx;
    const size_t square = (size_t)(source->size * source->size);
    OstLocal upper = 0;
    for (OstLocal i = 0; i < source->rows; i++)
        for (OstLocal k = source->row_start[i]; k < source->row_start[i + 1]; k++)
            upper += source->column[k] > i;
    OST_TRY(OST_NEW(ctx, &matrix->row_start, source->rows + 1));
    OST_TRY(OST_NEW(ctx, &matrix->own_end, source->rows));
    OST_TRY(OST_NEW(ctx, &matrix->column, upper));
    OST_TRY(OST_NEW(ctx, &matrix->diagonal, square * (size_t)source->rows + OST_PADDING));
    OST_TRY(OST_NEW(ctx, &matrix->value, square * (size_t)upper + OST_PADDING));
    if (source->size == 3)
        fill_upper_half(source, 3, matrix);
    else
        fill_upper_half(source, 6, matrix);
    return OST_SUCCESS;
}

OstStatus ost_level_matrix_create(const OstDoubleMatrix *source, OstLevelMatrix **matrix)
{
    OstContext *ctx = source->ctx;
    OstStatus status = OST_NEW(ctx, matrix, 1);
    if (status == OST_SUCCESS) {
        (*matrix)->ctx = ctx;
        (*matrix)->size = source->size;
        (*matrix)->rows = source->rows;
        (*matrix)->columns = source->columns;
        (*matrix)->nonzeros = (OstGlobal)(source->size * source->size) * source->row_start[source->rows];
        status = copy_upper_half(source, *matrix);
    }
    status = ost_agree(ctx, status);
    OST_THEN(ost_exchange_create(source->halo, source->size, &(*matrix)->exchange));
    if (status != OST_SUCCESS)
        ost_level_matrix_destroy(matrix);
    return status;
}

static void round_rest(size_t count, const double *source, float *rest)
{
    for (size_t k = 0; k < count; k++)
        rest[k] = (float)(source[k] - (double)(float)source[k]);
}

OstStatus ost_level_matrix_keep_rest(const OstDoubleMatrix *source, OstLevelMatrix *matrix)
{
    const int size = source->size;
    const size_t square = (size_t)(size * size);
    OstLocal upper = 0;
    double room[OST_BLOCK];
    OST_TRY(OST_NEW(source->ctx, &matrix->diagonal_rest, square * (size_t)source->rows + OST_PADDING));
    OST_TRY(OST_NEW(source->ctx, &matrix->value_rest, square * (size_t)matrix->row_start[source->rows] + OST_PADDING));
    for (OstLocal i = 0; i < source->rows; i++)
        for (OstLocal k = source->row_start[i]; k < source->row_start[i + 1]; k++) {
            const double *block = source->column[k] < i ? NULL : ost_double_matrix_block(source, size, i, k, room);
            if (block && source->column[k] == i)
                round_rest(square, block, matrix->diagonal_rest + square * (size_t)i);
            else if (block)
                round_rest(square, block, matrix->value_rest + square * (size_t)upper++);
        }
    return OST_SUCCESS;
}

OstStatus ost_level_vector_create(OstContext *ctx, int size, size_t columns, double **vector)
{
    return OST_NEW(ctx, vector, (size_t)size * columns + OST_PADDING);
}

/* 3 × 3 blocks. Each block right of the diagonal acts on its row and, transposed, on the row of its column. */
OST_KERNEL static void add3(const OstLevelMatrix *matrix, const float *diagonal, const float *value, double scale,
                            const double *restrict x, double *restrict y)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const double *own = x + 3 * (size_t)i;
        const float *a = diagonal + 9 * (size_t)i;
        const double x0 = scale * own[0], x1 = scale * own[1], x2 = scale * own[2];
        OstDouble4 v = OST_LOAD4(own);
        OstDouble4 s0 = OST_LOAD_FLOAT4(a) * v, s1 = OST_LOAD_FLOAT4(a + 3) * v, s2 = OST_LOAD_FLOAT4(a + 6) * v;
        OstLocal k = matrix->row_start[i];
        a = value + 9 * (size_t)k;
        for (; k < matrix->own_end[i]; k++, a += 9) {
            const size_t j = 3 * (size_t)matrix->column[k];
            const OstDouble4 a0 = OST_LOAD_FLOAT4(a), a1 = OST_LOAD_FLOAT4(a + 3), a2 = OST_LOAD_FLOAT4(a + 6);
            const OstDouble4 mirrored = a0 * x0 + a1 * x1 + a2 * x2;
            v = OST_LOAD4(x + j);
            s0 += a0 * v;
            s1 += a1 * v;
            s2 += a2 * v;
            ost_add_row3(&mirrored, y + j);
        }
        for (; k < matrix->row_start[i + 1]; k++, a += 9) {
            v = OST_LOAD4(x + 3 * (size_t)matrix->column[k]);
            s0 += OST_LOAD_FLOAT4(a) * v;
            s1 += OST_LOAD_FLOAT4(a + 3) * v;
            s2 += OST_LOAD_FLOAT4(a + 6) * v;
        }
        y[3 * (size_t)i] += scale * ost_sum_row3(&s0);
        y[3 * (size_t)i + 1] += scale * ost_sum_row3(&s1);
        y[3 * (size_t)i + 2] += scale * ost_sum_row3(&s2);
    }
}

/* The same with 6 × 6 blocks. */
OST_KERNEL static void add6(const OstLevelMatrix *matrix, const float *diagonal, const float *value, double scale,
                            const double *restrict x, double *restrict y)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const double *own = x + 6 * (size_t)i;
        const float *a = diagonal + 36 * (size_t)i;
        OstRow6 sum[6] = {{{0}, {0}}}, row, v;
        OstLocal k = matrix->row_start[i];
        ost_load_row6(own, &v);
        for (int r = 0; r < 6; r++) {
            ost_load_float_row6(a + 6 * r, &row);
            ost_add_product_row6(&row, &v, &sum[r]);
        }
        a = value + 36 * (size_t)k;
        for (; k < matrix->own_end[i]; k++, a += 36) {
            const size_t j = 6 * (size_t)matrix->column[k];
            OstRow6 mirrored = {{0}, {0}};
            ost_load_row6(x + j, &v);
            for (int r = 0; r < 6; r++) {
                ost_load_float_row6(a + 6 * r, &row);
                ost_add_product_row6(&row, &v, &sum[r]);
                ost_add_scaled_row6(scale * own[r], &row, &mirrored);
            }
            ost_add_row6(&mirrored, y + j);
        }
        for (; k < matrix->row_start[i + 1]; k++, a += 36) {
            ost_load_row6(x + 6 * (size_t)matrix->column[k], &v);
            for (int r = 0; r < 6; r++) {
                ost_load_float_row6(a + 6 * r, &row);
                ost_add_product_row6(&row, &v, &sum[r]);
            }
        }
        for (int r = 0; r < 6; r++)
            y[6 * (size_t)i + (size_t)r] += scale * ost_sum_row6(&sum[r]);
    }
}

static void add_part(const OstLevelMatrix *matrix, const float *diagonal, const float *value, double scale,
                     const double *x, double *y)
{
    ost_ledger_multiplied(matrix->ctx, (double)matrix->nonzeros);
    if (matrix->size == 3)
        add3(matrix, diagonal, value, scale, x, y);
    else
        add6(matrix, diagonal, value, scale, x, y);
}

void ost_level_matrix_add(const OstLevelMatrix *matrix, double scale, double *x, double *y)
{
    ost_exchange_import(matrix->exchange, x);
    add_part(matrix, matrix->diagonal, matrix->value, scale, x, y);
    if (matrix->value_rest)
        add_part(matrix, matrix->diagonal_rest, matrix->value_rest, scale, x, y);
}

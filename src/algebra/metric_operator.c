/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_operator.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

void ost_metric_operator_destroy(OstMetricOperator **op)
{
    if (!*op)
        return;
    OST_FREE((*op)->row_start);
    OST_FREE((*op)->column);
    OST_FREE((*op)->value);
    OST_FREE((*op)->exact);
    if (!(*op)->borrows_halo)
        ost_halo_destroy(&(*op)->halo);
    OST_FREE(*op);
}

OstStatus ost_metric_operator_round(OstMetricOperator *op, int exact)
{
    const size_t count = (size_t)(op->height * op->width) * (size_t)op->row_start[op->rows];
    OST_TRY(OST_NEW(op->ctx, &op->value, count));
    for (size_t k = 0; k < count; k++)
        op->value[k] = (float)op->exact[k];
    if (!exact)
        OST_FREE(op->exact);
    return OST_SUCCESS;
}

static OstStatus copy_matrix(const OstBlockMatrix *matrix, OstMetricOperator *op)
{
    const OstLocal blocks = matrix->row_start[matrix->rows];
    OST_TRY(OST_NEW(op->ctx, &op->row_start, matrix->rows + 1));
    OST_TRY(OST_NEW(op->ctx, &op->column, blocks));
    OST_TRY(OST_NEW(op->ctx, &op->exact, 9 * (size_t)blocks));
    memcpy(op->row_start, matrix->row_start, ((size_t)matrix->rows + 1) * sizeof(OstLocal));
    memcpy(op->column, matrix->column, (size_t)blocks * sizeof(OstLocal));
    for (OstLocal k = 0; k < blocks; k++)
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j < 3; j++)
                op->exact[9 * (size_t)k + 3 * j + i] = matrix->value[9 * (size_t)k + 3 * i + j];
    return OST_SUCCESS;
}

OstStatus ost_metric_operator_from_matrix(const OstBlockMatrix *matrix, int exact, OstMetricOperator **op)
{
    OstStatus status = OST_NEW(matrix->ctx, op, 1);
    if (status == OST_SUCCESS) {
        const OstMetricOperator empty = {.ctx = matrix->ctx,
                                         .height = 3,
                                         .width = 3,
                                         .rows = matrix->rows,
                                         .columns = matrix->columns,
                                         .halo = matrix->halo,
                                         .borrows_halo = 1};
        **op = empty;
        status = copy_matrix(matrix, *op);
    }
    if (status == OST_SUCCESS)
        status = ost_metric_operator_round(*op, exact);
    status = ost_agree(matrix->ctx, status);
    if (status != OST_SUCCESS)
        ost_metric_operator_destroy(op);
    return status;
}

/* y += scale A x for blocks whose size the compiler knows. */
static inline __attribute__((always_inline)) void add_blocks(const OstMetricOperator *op, int height, int width,
                                                             double scale, const double *restrict x, double *restrict y)
{
    const size_t block = (size_t)(height * width);
    for (OstLocal i = 0; i < op->rows; i++) {
        double sum[6] = {0};
        for (OstLocal k = op->row_start[i]; k < op->row_start[i + 1]; k++) {
            const float *a = op->value + block * (size_t)k;
            const double *v = x + (size_t)width * (size_t)op->column[k];
            for (int c = 0; c < width; c++)
                for (int r = 0; r < height; r++)
                    sum[r] += (double)a[c * height + r] * v[c];
        }
        for (int r = 0; r < height; r++)
            y[(size_t)height * (size_t)i + (size_t)r] += scale * sum[r];
    }
}

OstStatus ost_metric_operator_add(const OstMetricOperator *op, double scale, double *x, double *y)
{
    OST_TRY(ost_halo_import(op->halo, (size_t)op->width * sizeof *x, x));
    if (op->height == 3 && op->width == 3)
        add_blocks(op, 3, 3, scale, x, y);
    else if (op->height == 6 && op->width == 6)
        add_blocks(op, 6, 6, scale, x, y);
    else if (op->height == 3 && op->width == 6)
        add_blocks(op, 3, 6, scale, x, y);
    else
        return OST_RAISE(op->ctx, OST_INVALID_INPUT, "blocks of %d × %d; expected 3 × 3, 3 × 6 or 6 × 6", op->height,
                         op->width);
    return OST_SUCCESS;
}

OstStatus ost_metric_operator_apply_transposed(const OstMetricOperator *op, const double *x, double *y)
{
    const int height = op->height;
    const int width = op->width;
    memset(y, 0, (size_t)width * (size_t)op->columns * sizeof *y);
    for (OstLocal i = 0; i < op->rows; i++) {
        const double *v = x + (size_t)height * (size_t)i;
        for (OstLocal k = op->row_start[i]; k < op->row_start[i + 1]; k++) {
            const float *a = op->value + (size_t)(height * width) * (size_t)k;
            double *target = y + (size_t)width * (size_t)op->column[k];
            for (int c = 0; c < width; c++)
                for (int r = 0; r < height; r++)
                    target[c] += (double)a[c * height + r] * v[r];
        }
    }
    return ost_halo_add_to_owners(op->halo, width, y);
}

OstLocal ost_metric_operator_find(const OstMetricOperator *op, OstLocal row, OstLocal column)
{
    OstLocal low = op->row_start[row];
    OstLocal high = op->row_start[row + 1];
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (op->column[middle] == column)
            return middle;
        if (op->column[middle] < column)
            low = middle + 1;
        else
            high = middle;
    }
    return -1;
}

void ost_metric_operator_mend_diagonal(OstMetricOperator *op)
{
    const size_t size = (size_t)op->height;
    for (OstLocal i = 0; i < op->rows; i++) {
        const OstLocal k = ost_metric_operator_find(op, i, i);
        for (size_t c = 0; c < size && k >= 0; c++) {
            const size_t pivot = size * size * (size_t)k + (size + 1) * c;
            if (op->value[pivot] > 0.0f)
                continue;
            op->value[pivot] = 1.0f;
            if (op->exact)
                op->exact[pivot] = 1.0;
        }
    }
}

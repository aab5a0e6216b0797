/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/block_matrix.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

void ost_block_matrix_destroy(OstBlockMatrix **matrix)
{
    if (!*matrix)
        return;
    OST_FREE((*matrix)->row_start);
    OST_FREE((*matrix)->column);
    OST_FREE((*matrix)->diagonal);
    OST_FREE((*matrix)->value);
    ost_halo_destroy(&(*matrix)->halo);
    OST_FREE(*matrix);
}

static OstStatus copy_halo(const OstBlockMatrix *matrix, OstHalo **halo)
{
    OstLocal *same = NULL;
    OST_TRY(OST_NEW(matrix->ctx, &same, matrix->columns));
    for (OstLocal i = 0; i < matrix->columns; i++)
        same[i] = i;
    const OstStatus status = ost_halo_subset(matrix->halo, same, halo);
    OST_FREE(same);
    return status;
}

static OstStatus copy_pattern(const OstBlockMatrix *matrix, OstBlockMatrix *like)
{
    OstContext *ctx = matrix->ctx;
    const size_t rows = (size_t)matrix->rows;
    const size_t blocks = (size_t)matrix->row_start[rows];
    OST_TRY(OST_NEW(ctx, &like->row_start, rows + 1));
    OST_TRY(OST_NEW(ctx, &like->column, blocks));
    OST_TRY(OST_NEW(ctx, &like->diagonal, rows));
    OST_TRY(OST_NEW(ctx, &like->value, 9 * blocks));
    memcpy(like->row_start, matrix->row_start, (rows + 1) * sizeof *like->row_start);
    memcpy(like->column, matrix->column, blocks * sizeof *like->column);
    memcpy(like->diagonal, matrix->diagonal, rows * sizeof *like->diagonal);
    return copy_halo(matrix, &like->halo);
}

OstStatus ost_block_matrix_create_like(const OstBlockMatrix *matrix, OstBlockMatrix **like)
{
    OstBlockMatrix *made = NULL;
    *like = NULL;
    OstStatus status = OST_NEW(matrix->ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = matrix->ctx;
        made->rows = matrix->rows;
        made->columns = matrix->columns;
        made->first_row = matrix->first_row;
        made->global_rows = matrix->global_rows;
        status = copy_pattern(matrix, made);
    }
    status = ost_agree(matrix->ctx, status);
    if (status != OST_SUCCESS)
        ost_block_matrix_destroy(&made);
    *like = made;
    return status;
}

void ost_block_matrix_multiply(const OstBlockMatrix *matrix, const double *restrict x, double *restrict y)
{
    const OstLocal *restrict column = matrix->column;
    for (OstLocal i = 0; i < matrix->rows; i++) {
        double y0 = 0.0;
        double y1 = 0.0;
        double y2 = 0.0;
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

OstStatus ost_block_matrix_apply(const OstBlockMatrix *matrix, double *x, double *y)
{
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof *x, x));
    ost_block_matrix_multiply(matrix, x, y);
    return OST_SUCCESS;
}

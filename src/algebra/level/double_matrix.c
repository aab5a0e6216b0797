/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/double_matrix.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

OstStatus ost_double_matrix_borrow(const OstBlockMatrix *matrix, const OstScaling *scaling, OstDoubleMatrix **source)
{
    OST_TRY(OST_NEW(matrix->ctx, source, 1));
    **source = (OstDoubleMatrix){.ctx = matrix->ctx,
                                 .size = 3,
                                 .of = matrix,
                                 .scaling = scaling,
                                 .rows = matrix->rows,
                                 .columns = matrix->columns,
                                 .row_start = matrix->row_start,
                                 .column = matrix->column,
                                 .halo = matrix->halo};
    return OST_SUCCESS;
}

static void free_chunks(OstDoubleMatrix *matrix)
{
    OST_FREE_EACH(matrix->chunks, matrix->chunk);
    OST_FREE(matrix->place);
    matrix->chunks = 0;
}

void ost_double_matrix_destroy(OstDoubleMatrix **source)
{
    if (!*source)
        return;
    if (!(*source)->of) {
        OST_FREE((*source)->row_start, (*source)->column, (*source)->value);
        free_chunks(*source);
        ost_halo_destroy(&(*source)->halo);
    }
    OST_FREE(*source);
}

OstStatus ost_double_matrix_numbers(const OstDoubleMatrix *matrix, OstGlobal first, OstGlobal **number)
{
    OST_TRY(ost_agree(matrix->ctx, OST_NEW(matrix->ctx, number, matrix->columns)));
    for (OstLocal i = 0; i < matrix->rows; i++)
        (*number)[i] = first + (OstGlobal)matrix->size * i;
    return ost_agree(matrix->ctx, ost_halo_import(matrix->halo, sizeof **number, *number));
}

OstStatus ost_double_matrix_unfold(OstDoubleMatrix *matrix)
{
    const OstLocal entries = matrix->row_start[matrix->rows];
    double room[OST_BLOCK];
    if (matrix->value)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(matrix->ctx, &matrix->value, OST_BLOCK * (size_t)entries));
    for (OstLocal k = 0; k < entries; k++)
        memcpy(matrix->value + OST_BLOCK * (size_t)k, ost_double_matrix_block(matrix, OST_MODES, 0, k, room),
               sizeof room);
    free_chunks(matrix);
    return OST_SUCCESS;
}

double *ost_double_matrix_find(const OstDoubleMatrix *matrix, OstLocal row, OstLocal column)
{
    const OstLocal k = ost_row_find(matrix->row_start, matrix->column, row, column);
    if (matrix->chunk)
        return ost_chunk_block(matrix->chunk, matrix->place[k] >= 0 ? matrix->place[k] : ~matrix->place[k]);
    return matrix->value + (size_t)(matrix->size * matrix->size) * (size_t)k;
}

double *ost_double_matrix_diagonal(const OstDoubleMatrix *matrix, OstLocal row)
{
    return ost_double_matrix_find(matrix, row, row);
}

void ost_double_matrix_mend_diagonal(OstDoubleMatrix *matrix)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        double *block = ost_double_matrix_diagonal(matrix, i);
        for (int c = 0; c < matrix->size; c++)
            if (!(block[(matrix->size + 1) * c] > 0.0))
                block[(matrix->size + 1) * c] = 1.0;
    }
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/double_matrix.h"

#include "core/error.h"
#include "core/memory.h"

OstStatus ost_exact_matrix_borrow(const OstBlockMatrix *matrix, const OstScaling *scaling, OstExactMatrix **exact)
{
    OST_TRY(OST_NEW(matrix->ctx, exact, 1));
    **exact = (OstExactMatrix){.ctx = matrix->ctx,
                               .size = 3,
                               .borrowed = 1,
                               .scaling = scaling,
                               .rows = matrix->rows,
                               .columns = matrix->columns,
                               .row_start = matrix->row_start,
                               .column = matrix->column,
                               .value = matrix->value,
                               .halo = matrix->halo};
    return OST_SUCCESS;
}

void ost_exact_matrix_destroy(OstExactMatrix **exact)
{
    if (!*exact)
        return;
    if (!(*exact)->borrowed) {
        OST_FREE((*exact)->row_start);
        OST_FREE((*exact)->column);
        OST_FREE((*exact)->value);
        ost_halo_destroy(&(*exact)->halo);
    }
    OST_FREE(*exact);
}

double *ost_exact_matrix_diagonal(const OstExactMatrix *matrix, OstLocal row)
{
    OstLocal low = matrix->row_start[row];
    OstLocal high = matrix->row_start[row + 1] - 1;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (matrix->column[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return matrix->value + (size_t)(matrix->size * matrix->size) * (size_t)low;
}

void ost_exact_matrix_mend_diagonal(OstExactMatrix *matrix)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        double *block = ost_exact_matrix_diagonal(matrix, i);
        for (int c = 0; c < matrix->size; c++)
            if (!(block[(matrix->size + 1) * c] > 0.0))
                block[(matrix->size + 1) * c] = 1.0;
    }
}

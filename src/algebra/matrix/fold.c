/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/fold.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

/* Where the blocks right of the diagonal will be. As rows ascend, those of a row are the mirrors in their order:
 * next[r] is the entry of row r that is the next one. Returns 0 where
 * an entry has no mirror. */
static int list(const OstBlockMatrix *matrix, OstLocal *next, OstLocal *upper, OstLocal *mirror)
{
    OstLocal kept = 0, left = 0;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const OstLocal diagonal = matrix->diagonal[row];
        upper[row] = kept;
        for (OstLocal k = matrix->row_start[row]; k < diagonal; k++) {
            const OstLocal other = matrix->column[k], entry = next[other]++;
            if (entry >= matrix->row_start[other + 1] || matrix->column[entry] != row)
                return 0;
            mirror[left++] = upper[other] + entry - matrix->diagonal[other];
        }
        next[row] = diagonal + 1;
        kept += matrix->row_start[row + 1] - diagonal;
    }
    for (OstLocal row = 0; row < matrix->rows; row++) /* is each of them a mirror? Ghosts have no rows here. */
        if (next[row] < matrix->row_start[row + 1] && matrix->column[next[row]] < matrix->rows)
            return 0;
    return 1;
}

OstStatus ost_block_matrix_fold(OstBlockMatrix *matrix)
{
    OstContext *ctx = matrix->ctx;
    OstLocal *next = NULL, *upper = NULL, *mirror = NULL;
    size_t kept = 0;
    if (matrix->upper || matrix->rows == 0)
        return OST_SUCCESS;
    for (OstLocal row = 0; row < matrix->rows; row++)
        kept += (size_t)(matrix->row_start[row + 1] - matrix->diagonal[row]);
    OstStatus status = OST_NEW(ctx, &next, matrix->rows);
    OST_THEN(OST_NEW(ctx, &upper, matrix->rows));
    OST_THEN(OST_NEW(ctx, &mirror, (size_t)matrix->row_start[matrix->rows] - kept));
    if (status != OST_SUCCESS || !list(matrix, next, upper, mirror))
        goto done;
    for (OstLocal row = 0; row < matrix->rows; row++)
        memmove(matrix->value + 9 * (size_t)upper[row], matrix->value + 9 * (size_t)matrix->diagonal[row],
                9 * (size_t)(matrix->row_start[row + 1] - matrix->diagonal[row]) * sizeof *matrix->value);
    status = OST_RESIZE(ctx, &matrix->value, 9 * kept);
    matrix->upper = upper;
    matrix->mirror = mirror;
    upper = mirror = NULL;
done:
    OST_FREE(next, upper, mirror);
    return status;
}

OstStatus ost_block_matrix_unfold(OstBlockMatrix *matrix)
{
    double *value = NULL;
    if (!matrix->upper)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(matrix->ctx, &value, 9 * (size_t)matrix->row_start[matrix->rows]));
    for (OstLocal row = 0; row < matrix->rows; row++)
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
            double room[9];
            memcpy(value + 9 * (size_t)k, ost_block_matrix_block(matrix, row, k, room), sizeof room);
        }
    OST_FREE(matrix->value, matrix->upper, matrix->mirror);
    matrix->value = value;
    return OST_SUCCESS;
}

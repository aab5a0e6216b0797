/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/triangle.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

void ost_triangle_clear(OstBlockMatrix *matrix)
{
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const size_t first = (size_t)matrix->diagonal[row];
        const size_t end = (size_t)matrix->row_start[row + 1];
        memset(matrix->value + 9 * first, 0, 9 * (end - first) * sizeof(double));
    }
}

/* As rows ascend, each row's blocks right of the diagonal are needed in their order: next[r] is the next one of row r.
 */
OstStatus ost_triangle_mirror(OstBlockMatrix *matrix)
{
    OstLocal *next = NULL;
    OST_TRY(OST_NEW(matrix->ctx, &next, matrix->rows));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        for (OstLocal block = matrix->row_start[row]; block < matrix->diagonal[row]; block++) {
            const OstLocal mirror = next[matrix->column[block]]++;
            const double *source = matrix->value + 9 * (size_t)mirror;
            double *target = matrix->value + 9 * (size_t)block;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    target[3 * i + j] = source[3 * j + i];
        }
        next[row] = matrix->diagonal[row] + 1;
    }
    OST_FREE(next);
    return OST_SUCCESS;
}

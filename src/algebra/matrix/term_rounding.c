/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/term_rounding.h"

#include <float.h>
#include <math.h>

static void add_squares(const double *block, const double *u, double *square)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            square[i] += (block[3 * i + j] * u[j]) * (block[3 * i + j] * u[j]);
}

void ost_term_rounding(const OstBlockMatrix *matrix, const double *u, double *rounding)
{
    for (OstLocal row = 0; row < matrix->rows; row++) {
        double square[3] = {0.0};
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++)
            add_squares(matrix->value + 9 * (size_t)k, u + 3 * (size_t)matrix->column[k], square);
        for (int i = 0; i < 3; i++)
            rounding[3 * (size_t)row + (size_t)i] = DBL_EPSILON * sqrt(square[i]);
    }
}

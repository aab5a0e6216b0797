/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rounded_stiffness.h"

#include "core/scatter.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double sure = 3.0; /* standard errors */

/* Entries (i, j) and (j, i) must get the same sign: a pair of blocks shares nine random bits, and these tables say
 * which bit is each entry's. */
typedef enum { BELOW_DIAGONAL, ABOVE_DIAGONAL, ON_DIAGONAL } Place;

static const int bit_of_entry[][9] = {
    [BELOW_DIAGONAL] = {0, 1, 2, 3, 4, 5, 6, 7, 8},
    [ABOVE_DIAGONAL] = {0, 3, 6, 1, 4, 7, 2, 5, 8},
    [ON_DIAGONAL] = {0, 3, 6, 3, 4, 7, 6, 7, 8},
};

static inline Place place_of_block(OstGlobal i, OstGlobal j)
{
    if (i == j)
        return ON_DIAGONAL;
    return i > j ? BELOW_DIAGONAL : ABOVE_DIAGONAL;
}

static inline uint64_t bits_of_pair(OstGlobal i, OstGlobal j, int which)
{
    const uint64_t low = (uint64_t)(i < j ? i : j), high = (uint64_t)(i < j ? j : i);
    return ost_scatter(ost_scatter(ost_scatter(low) + high) + (uint64_t)which);
}

static inline void add_block(const double *block, uint64_t bits, Place place, const double *u, double *force)
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            const double half = (double)(int)(bits >> bit_of_entry[place][3 * r + c] & 1) - 0.5;
            force[r] += half * DBL_EPSILON * (block[3 * r + c] * u[c]);
        }
}

void ost_rounded_stiffness_force(const OstBlockMatrix *matrix, const double *u, int which, double *force)
{
    memset(force, 0, 3 * (size_t)matrix->rows * sizeof *force);
    for (OstLocal row = 0; row < matrix->rows; row++)
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
            const OstLocal column = matrix->column[k];
            double room[9];
            const OstGlobal i = matrix->label[row], j = matrix->label[column];
            add_block(ost_block_matrix_block(matrix, row, k, room), bits_of_pair(i, j, which), place_of_block(i, j),
                      u + 3 * (size_t)column, force + 3 * (size_t)row);
        }
}

static void add_squares(const double *block, const double *u, double *square)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            square[i] += (block[3 * i + j] * u[j]) * (block[3 * i + j] * u[j]);
}

void ost_term_rounding(const OstBlockMatrix *matrix, const double *u, double *rounding)
{
    for (OstLocal row = 0; row < matrix->rows; row++) {
        double square[3] = {0.0}, room[9];
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++)
            add_squares(ost_block_matrix_block(matrix, row, k, room), u + 3 * (size_t)matrix->column[k], square);
        for (int i = 0; i < 3; i++)
            rounding[3 * (size_t)row + (size_t)i] = DBL_EPSILON * sqrt(square[i]);
    }
}

double ost_samples_size(const OstSamples *samples)
{
    return sqrt(samples->squares / samples->count);
}

double ost_samples_spread(const OstSamples *samples)
{
    return 1.0 / sqrt(2.0 * samples->count);
}

int ost_surely_beyond(double size, double spread, double limit)
{
    return !(size <= (1.0 + sure * spread) * limit);
}

int ost_samples_undecided(const OstSamples *samples, double limit, int fewest, int most)
{
    if (samples->count < fewest)
        return 1;
    const double size = ost_samples_size(samples), margin = sure * ost_samples_spread(samples) * limit;
    return samples->count < most && fabs(size - limit) <= margin;
}

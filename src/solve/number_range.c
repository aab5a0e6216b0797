/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/number_range.h"

#include "core/error.h"

#include <math.h>

static const double least = 1e-75;
static const double most = 1e75;

static OstStatus check(OstContext *ctx, const char *where, const char *what, double size)
{
    if (size >= least && size <= most)
        return OST_SUCCESS;
    if (!isfinite(size))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: the %s are not finite everywhere; look for what is no number",
                         where, what);
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: the %s are of size %.2g in the case's units; beyond %g to %g, squares leave the range of "
                     "double precision: choose units of length and force that bring them nearer to 1",
                     where, what, size, least, most);
}

/* Largest absolute value; infinite if one is no number. */
static double largest_of(size_t count, const double *values)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; i++)
        if (!(fabs(values[i]) <= largest))
            largest = isfinite(values[i]) ? fabs(values[i]) : HUGE_VAL;
    return largest;
}

/* The softest node counts too: its displacement is the largest. */
static void diagonal_range(const OstBlockMatrix *matrix, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = 0.0;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const double size = largest_of(9, matrix->value + 9 * (size_t)matrix->diagonal[row]);
        *low = fmin(*low, size);
        *high = fmax(*high, size);
    }
}

OstStatus ost_number_range_check(const OstSystem *system, const double *rhs, const char *where)
{
    OstContext *ctx = system->ctx;
    const OstBlockMatrix *matrix = system->matrix;
    double low;
    double largest[3]; /* right-hand side, stiffness, and the inverse of the softest */
    largest[0] = largest_of(3 * (size_t)matrix->rows, rhs);
    diagonal_range(matrix, &low, &largest[1]);
    largest[2] = 1.0 / low;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, largest, 3, MPI_DOUBLE, MPI_MAX, ost_comm(ctx))));
    if (matrix->global_rows == 0)
        return OST_SUCCESS;
    OST_TRY(check(ctx, where, "stiffest nodes", largest[1]));
    OST_TRY(check(ctx, where, "softest nodes", 1.0 / largest[2]));
    return largest[0] > 0.0 ? check(ctx, where, "loads", largest[0]) : OST_SUCCESS;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/number_range.h"

#include "core/error.h"
#include "core/parallel/reduce.h"

#include <math.h>

static const double least = 1e-75;
static const double most = 1e75;

static OstStatus check(OstContext *ctx, const char *where, const char *what, double size)
{
    if (size >= least && size <= most)
        return OST_SUCCESS;
    if (!isfinite(size))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "%s: the %s are not finite everywhere; look for a value that is infinite or no number", where,
                         what);
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: the %s are of size %.2g in the case's units; beyond %g to %g, squares leave the range of "
                     "double precision: choose units of length and force that bring them nearer to 1",
                     where, what, size, least, most);
}

/* Largest absolute value; infinite if a value is NaN. */
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

OstStatus ost_number_range_of_stiffness(const OstBlockMatrix *matrix, const char *where)
{
    OstContext *ctx = matrix->ctx;
    double low, largest[2]; /* the stiffest node, and 1 over the softest */
    diagonal_range(matrix, &low, &largest[0]);
    largest[1] = 1.0 / low;
    OST_TRY(ost_max(ctx, 2, largest));
    OST_TRY(check(ctx, where, "stiffest nodes", largest[0]));
    return check(ctx, where, "softest nodes", 1.0 / largest[1]);
}

OstStatus ost_number_range_of_load(const OstBlockMatrix *matrix, const double *rhs, const char *where)
{
    OstContext *ctx = matrix->ctx;
    double largest = largest_of(3 * (size_t)matrix->rows, rhs);
    OST_TRY(ost_max(ctx, 1, &largest));
    return largest > 0.0 ? check(ctx, where, "loads", largest) : OST_SUCCESS;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/curve.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"

#include <float.h>
#include <math.h>

enum { BITS = 21 }; /* of each coordinate: a place has 63 */

/* The corner and the width of the smallest cube with all points. */
static OstStatus find_cube(OstContext *ctx, OstLocal count, const double *x, double corner[3], double *width)
{
    double range[6]; /* largest, and largest negative coordinates */
    for (int d = 0; d < 6; d++)
        range[d] = -DBL_MAX;
    for (OstLocal i = 0; i < count; i++)
        for (int d = 0; d < 3; d++) {
            range[d] = fmax(range[d], x[3 * (size_t)i + (size_t)d]);
            range[3 + d] = fmax(range[3 + d], -x[3 * (size_t)i + (size_t)d]);
        }
    OST_TRY(ost_max(ctx, 6, range));
    *width = DBL_MIN;
    for (int d = 0; d < 3; d++) {
        corner[d] = -range[3 + d];
        *width = fmax(*width, range[d] - corner[d]);
    }
    return OST_SUCCESS;
}

/* Along Morton's curve: the bits of the three coordinates in turn. */
static void find_places(OstLocal count, const double *x, const double corner[3], double width, OstGlobal *place)
{
    const double last = (1 << BITS) - 1;
    for (OstLocal i = 0; i < count; i++)
        for (int d = 0; d < 3; d++) {
            const double share = (x[3 * (size_t)i + (size_t)d] - corner[d]) / width;
            const OstGlobal cell = (OstGlobal)fmin(last * share, last); /* also where the width overflows */
            for (int b = 0; b < BITS; b++)
                place[i] |= (cell >> b & 1) << (3 * b + d);
        }
}

/* Where each rank's slab ends: all by bisection at once. `places` are sorted, each once. */
static OstStatus find_ends(OstContext *ctx, OstLocal count, const OstGlobal *places, OstGlobal *below, OstGlobal *end)
{
    const int size = ost_size(ctx);
    OstGlobal total = count;
    OST_TRY(ost_sum_numbers(ctx, 1, &total));
    for (int b = 3 * BITS - 1; b >= 0; b--) {
        for (int r = 0; r < size; r++)
            below[r] = ost_numbers_below(count, places, end[r] | (OstGlobal)1 << b);
        OST_TRY(ost_sum_numbers(ctx, size, below));
        for (int r = 0; r < size; r++)
            if ((double)below[r] <= (double)total * (r + 1) / size)
                end[r] |= (OstGlobal)1 << b;
    }
    return OST_SUCCESS;
}

OstStatus ost_curve_slabs(OstContext *ctx, OstLocal count, const double *x, int *to)
{
    double corner[3], width;
    OstGlobal *place = NULL, *sorted = NULL, *end = NULL;
    const size_t size = (size_t)ost_size(ctx);
    OstStatus status = OST_NEW(ctx, &place, count);
    OST_THEN(OST_NEW(ctx, &sorted, count));
    OST_THEN(OST_NEW(ctx, &end, 2 * size));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(find_cube(ctx, count, x, corner, &width));
    find_places(count, x, corner, width, place);
    for (OstLocal i = 0; i < count; i++)
        sorted[i] = place[i];
    OST_TRY_DONE(find_ends(ctx, ost_numbers_sort(count, sorted), sorted, end + size, end));
    for (OstLocal i = 0; i < count; i++)
        to[i] = ost_number_holder(end, (int)size, place[i]);
done:
    OST_FREE(place, sorted, end);
    return status;
}

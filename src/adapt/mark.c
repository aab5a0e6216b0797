/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/mark.h"

#include "core/error.h"
#include "core/parallel/reduce.h"

#include <math.h>

/* Cuts of a tet until a child's share is at most `share`. */
static int cuts(const OstMarking *marking, double error, double share)
{
    const double fall = 2.0 * marking->order / 3.0 + 1.0; /* of a child's share in one cut, as a power of 1/2 */
    if (!(error > share))
        return 0;
    return (int)fmin(ceil(log2(error / share) / fall), OST_MOST_CUTS);
}

/* Collective. What is expected if no share is to be above this one. */
static OstStatus expect(const OstMesh *mesh, const double *error, double share, OstMarking *marking)
{
    double sum[2] = {0.0, 0.0};
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        const int times = cuts(marking, error[t], share);
        sum[0] += ldexp(1.0, times);
        sum[1] += error[t] * exp2(-2.0 * marking->order / 3.0 * times);
    }
    OST_TRY(ost_sum(mesh->ctx, 2, sum));
    marking->expected_tets = sum[0];
    marking->expected_square = sum[1];
    return OST_SUCCESS;
}

/* The largest share that meets the target; where that takes too many tets, the smallest that does not. */
static OstStatus find_share(const OstMesh *mesh, const double *error, double most, OstMarking *marking, double *share)
{
    enum { STEPS = 40 };
    double low = -100.0, high = 0.0; /* powers of 2, of the largest share */
    for (int step = 0; step < STEPS; step++) {
        const double middle = 0.5 * (low + high);
        OST_TRY(expect(mesh, error, most * exp2(middle), marking));
        const int too_many = marking->expected_tets > marking->most_tets;
        if (too_many || marking->expected_square <= marking->target)
            low = middle;
        else
            high = middle;
    }
    *share = most * exp2(low);
    OST_TRY(expect(mesh, error, *share, marking));
    if (marking->expected_tets > marking->most_tets) {
        *share = most * exp2(high);
        return expect(mesh, error, *share, marking);
    }
    return OST_SUCCESS;
}

OstStatus ost_mark(const OstMesh *mesh, const double *error, OstMarking *marking, unsigned char *times)
{
    double most = 0.0, share = 0.0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        most = fmax(most, error[t]);
    OST_TRY(ost_max(mesh->ctx, 1, &most));
    share = most; /* no tet is cut */
    OST_TRY(expect(mesh, error, share, marking));
    if (marking->expected_square > marking->target)
        OST_TRY(find_share(mesh, error, most, marking, &share));
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        times[t] = (unsigned char)cuts(marking, error[t], share);
    return OST_SUCCESS;
}

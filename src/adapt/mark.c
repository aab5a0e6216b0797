/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/mark.h"

#include "core/error.h"
#include "core/parallel/reduce.h"

#include <math.h>

double ost_smooth_fall(int order)
{
    return 2.0 * order / 3.0 + 1.0;
}

double ost_found_fall(int order, double before, double after, int cuts)
{
    const double least = 0.4; /* less is noise: children at the end of a crack have 2^-0.67 of the share */
    if (!(after > 0.0))
        return ost_smooth_fall(order);
    return fmin(fmax(log2(before / after) / cuts, least), ost_smooth_fall(order));
}

/* What is to be marked. */
typedef struct Shares {
    const OstMesh *mesh;
    const double *error, *fall;
} Shares;

/* Cuts of a tet until a child's share is at most `share`. */
static int cuts(const Shares *shares, OstLocal tet, double share)
{
    if (!(shares->error[tet] > share))
        return 0;
    return (int)fmin(ceil(log2(shares->error[tet] / share) / shares->fall[tet]), OST_MOST_CUTS);
}

/* Collective. What is expected if no share is to be above this one. The children together have 2^(-2 order / 3) of the
 * share in each cut where the solution is smooth, and near an edge about the same part of the power of one child. */
static OstStatus expect(const Shares *shares, double share, OstMarking *marking)
{
    const double together = 2.0 * marking->order / 3.0 / ost_smooth_fall(marking->order);
    double sum[2] = {0.0, 0.0};
    for (OstLocal t = 0; t < shares->mesh->owned_tets; t++) {
        const int times = cuts(shares, t, share);
        sum[0] += ldexp(1.0, times);
        sum[1] += shares->error[t] * exp2(-together * shares->fall[t] * times);
    }
    OST_TRY(ost_sum(shares->mesh->ctx, 2, sum));
    marking->expected_tets = sum[0];
    marking->expected_square = sum[1];
    return OST_SUCCESS;
}

/* Shares are looked for on this grid, in steps a power of 2: the one that just meets the target would be that of some
 * tet, and rounding would decide whether it and its likes are cut. */
static const int grid = 8;

/* The largest share, above `least`, that is expected to have this many tets and squared error, with no more tets than
 * allowed. */
static OstStatus find_share(const Shares *shares, double least, double most, double tets, double square,
                            OstMarking *marking, double *share)
{
    int low = (int)floor(grid * log2(least)), high = (int)ceil(grid * log2(most));
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        OST_TRY(expect(shares, exp2((double)middle / grid), marking));
        if (marking->expected_tets > marking->most_tets ||
            (marking->expected_tets >= tets && marking->expected_square <= square))
            low = middle;
        else
            high = middle;
    }
    *share = exp2((double)low / grid);
    OST_TRY(expect(shares, *share, marking));
    if (marking->expected_tets <= marking->most_tets)
        return OST_SUCCESS;
    *share = exp2((double)high / grid);
    return expect(shares, *share, marking);
}

OstStatus ost_mark(const OstMesh *mesh, const double *error, const double *fall, OstMarking *marking,
                   unsigned char *times)
{
    const Shares shares = {mesh, error, fall};
    double bound[2] = {0.0, 0.0}; /* the largest share, and the least that all tets can reach in one level */
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        bound[0] = fmax(bound[0], error[t]);
        bound[1] = fmax(bound[1], error[t] * exp2(-OST_MOST_CUTS * fall[t]));
    }
    OST_TRY(ost_max(mesh->ctx, 2, bound));
    double share = bound[0];
    OST_TRY(expect(&shares, share, marking));
    if (marking->expected_square > (1.0 + 1e-9) * marking->target && bound[1] > 0.0)
        OST_TRY(find_share(&shares, bound[1], bound[0], 0.0, marking->target, marking, &share));
    if (marking->expected_tets < marking->least_tets && marking->least_share < share)
        OST_TRY(find_share(&shares, marking->least_share, share, marking->least_tets, INFINITY, marking, &share));
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        times[t] = (unsigned char)cuts(&shares, t, share);
    return OST_SUCCESS;
}

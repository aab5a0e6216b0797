/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/lanczos.h"

#include "core/error.h"
#include "core/memory.h"

#include <float.h>
#include <math.h>

/* More steps would not change the estimate. Few solves take more than the second number, so that a high iteration limit
 * costs no memory. */
enum { MOST_STEPS = 10000, FIRST_STEPS = 1000, GROWTH = 4 };

static int least(int one, int other)
{
    return one < other ? one : other;
}

OstStatus ost_lanczos_create(OstContext *ctx, int steps, OstLanczos *lanczos)
{
    lanczos->ctx = ctx;
    lanczos->most = least(steps, MOST_STEPS);
    lanczos->room = least(lanczos->most, FIRST_STEPS);
    lanczos->count = 0;
    lanczos->alpha = NULL;
    lanczos->weight = NULL;
    OST_TRY(OST_NEW(ctx, &lanczos->alpha, lanczos->room));
    return OST_NEW(ctx, &lanczos->weight, lanczos->room);
}

void ost_lanczos_destroy(OstLanczos *lanczos)
{
    OST_FREE(lanczos->alpha, lanczos->weight);
}

static OstStatus grow(OstLanczos *lanczos)
{
    const int room = least(GROWTH * lanczos->room, lanczos->most);
    OstStatus status = OST_RESIZE(lanczos->ctx, &lanczos->alpha, room);
    OST_THEN(OST_RESIZE(lanczos->ctx, &lanczos->weight, room));
    OST_TRY(ost_agree(lanczos->ctx, status));
    lanczos->room = room;
    return OST_SUCCESS;
}

OstStatus ost_lanczos_add(OstLanczos *lanczos, double alpha, double weight)
{
    if (lanczos->count >= lanczos->most)
        return OST_SUCCESS;
    if (lanczos->count == lanczos->room)
        OST_TRY(grow(lanczos));
    lanczos->alpha[lanczos->count] = alpha;
    lanczos->weight[lanczos->count++] = weight;
    return OST_SUCCESS;
}

static double beta(const OstLanczos *lanczos, int k)
{
    return lanczos->weight[k] / lanczos->weight[k - 1];
}

/* Row k of the Lanczos matrix: its diagonal entry, and the square of the entry below the diagonal. */
static double diagonal(const OstLanczos *lanczos, int k)
{
    const double coupling = k > 0 ? beta(lanczos, k) / lanczos->alpha[k - 1] : 0.0;
    return 1.0 / lanczos->alpha[k] + coupling;
}

static double off_diagonal_square(const OstLanczos *lanczos, int k)
{
    return beta(lanczos, k + 1) / (lanczos->alpha[k] * lanczos->alpha[k]);
}

/* The number of eigenvalues below x (Sturm sequence). */
static int count_below(const OstLanczos *lanczos, double x)
{
    int count = 0;
    double pivot = 1.0;
    for (int k = 0; k < lanczos->count; k++) {
        pivot = diagonal(lanczos, k) - x - (k > 0 ? off_diagonal_square(lanczos, k - 1) / pivot : 0.0);
        if (pivot == 0.0)
            pivot = -DBL_MIN;
        count += pivot < 0.0;
    }
    return count;
}

/* Eigenvalue number `below`, counted from 0. */
static double bisect(const OstLanczos *lanczos, int below, double high)
{
    double low = 0.0;
    while (high - low > 1e-12 * high && high > DBL_MIN) {
        const double middle = 0.5 * (low + high);
        if (count_below(lanczos, middle) > below)
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* Gershgorin's bound on the largest eigenvalue. */
static double upper_bound(const OstLanczos *lanczos)
{
    const int n = lanczos->count;
    double bound = 0.0;
    for (int k = 0; k < n; k++) {
        const double before = k > 0 ? sqrt(off_diagonal_square(lanczos, k - 1)) : 0.0;
        const double after = k + 1 < n ? sqrt(off_diagonal_square(lanczos, k)) : 0.0;
        bound = fmax(bound, diagonal(lanczos, k) + before + after);
    }
    return bound;
}

void ost_lanczos_extremes(const OstLanczos *lanczos, double *smallest, double *largest)
{
    const double bound = upper_bound(lanczos);
    *smallest = *largest = 0.0;
    if (lanczos->count == 0 || !isfinite(bound))
        return;
    *smallest = bisect(lanczos, 0, bound);
    *largest = bisect(lanczos, lanczos->count - 1, bound);
}

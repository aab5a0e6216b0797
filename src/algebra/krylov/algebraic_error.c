/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/algebraic_error.h"

#include <math.h>

/* The last stretch of the iteration is compared with so many before it: no fewer, or chance decides; no more, as the
 * iteration becomes faster. */
enum { FEWEST_STRETCHES = 2, MOST_STRETCHES = 6 };

static const double below_smallest = 0.5; /* of the Lanczos matrix's smallest eigenvalue */

/* By which step k lowered the squared error. */
static double gain(const OstLanczos *lanczos, int k)
{
    return lanczos->alpha[k] * lanczos->weight[k];
}

/* The gain of `length` steps, after which `later` such stretches came. */
static double stretch_gain(const OstLanczos *lanczos, int length, int later)
{
    const int end = lanczos->count - later * length;
    double sum = 0.0;
    for (int k = end - length; k < end; k++)
        sum += gain(lanczos, k);
    return sum;
}

/* The squared error x of the last iterate. Let s be the largest ratio, over the last stretches, of the squared error at
 * the beginning of a stretch, which is x and what was gained since, to what the stretch gained. With that ratio for the
 * last stretch too, x and its gain are s times its gain. INFINITY if the last one did not gain the least. */
static double extrapolate_by(const OstLanczos *lanczos, int length)
{
    const double last = stretch_gain(lanczos, length, 0);
    double since = 0.0, ratio = 0.0;
    for (int later = 1; later <= MOST_STRETCHES && (later + 1) * length <= lanczos->count; later++) {
        const double gained = stretch_gain(lanczos, length, later);
        since += gained;
        if (!(gained > last))
            return INFINITY;
        ratio = fmax(ratio, since / (gained - last));
    }
    return (ratio - 1.0) * last;
}

/* Where gains go up and down, stretches of more steps are compared. */
static double extrapolate(const OstLanczos *lanczos)
{
    double square = INFINITY;
    for (int length = 1; (1 + FEWEST_STRETCHES) * length <= lanczos->count && isinf(square); length *= 2)
        square = extrapolate_by(lanczos, length);
    return square;
}

/* Gauss-Radau's bound on the squared error: the last weight times the length that the last step would have if the
 * Lanczos matrix had an eigenvalue at `low`, less what that step gained. */
static double find_bound(const OstLanczos *lanczos, double low)
{
    const int last = lanczos->count - 1;
    double length = 1.0 / low;
    for (int k = 0; k < last; k++) {
        const double rest = length - lanczos->alpha[k];
        length = rest / (low * rest + lanczos->weight[k + 1] / lanczos->weight[k]);
    }
    return (length - lanczos->alpha[last]) * lanczos->weight[last];
}

void ost_algebraic_error(const OstLanczos *lanczos, OstAlgebraicError *error)
{
    double smallest, largest, energy = 0.0;
    for (int k = 0; k < lanczos->count; k++)
        energy += gain(lanczos, k);
    ost_lanczos_extremes(lanczos, &smallest, &largest);
    const double bound = smallest > 0.0 ? find_bound(lanczos, below_smallest * smallest) : INFINITY;
    error->size = sqrt(energy);
    error->bound = sqrt(fmax(bound, 0.0));
    error->estimate = sqrt(extrapolate(lanczos));
}

double ost_algebraic_error_rate(const OstLanczos *lanczos, const OstAlgebraicError *error)
{
    const double square = error->estimate * error->estimate;
    return isfinite(square) ? sqrt(square / (square + gain(lanczos, lanczos->count - 1))) : 1.0;
}

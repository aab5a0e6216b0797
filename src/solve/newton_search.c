/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "solve/newton_data.h"

#include <math.h>
#include <string.h>

/* Armijo's condition asks for this share of the decrease that the slope promises. */
static const double share = 1e-4;

/* Differences of the energy below this share of its terms drown in rounding; the slope decides there (approximate Wolfe
 * condition: Hager and Zhang, A new conjugate gradient method with guaranteed descent and an efficient line search,
 * SIAM J. Optim. 16, 2005). */
static const double drowned = 1e-11;

/* A step is cut to between these shares of itself. */
static const double least_cut = 0.1, most_cut = 0.5;

enum { MOST_CUTS = 20 };

/* What the search goes by, at one step length: the energy and its slope, or, without an energy, the squared residual
 * and its slope, twice its negative. */
typedef struct Point {
    double length, value, slope;
} Point;

/* The slope of the energy along the direction is -residual·correction. */
static OstStatus measure(const OstNewton *newton, double length, Point *point)
{
    double slope = 0.0;
    for (size_t i = 0; i < 3 * (size_t)newton->problem->system->matrix->rows; i++)
        slope -= newton->residual[i] * newton->correction[i];
    OST_TRY(ost_sum(newton->ctx, 1, &slope));
    *point = (Point){length, newton->energy, slope};
    if (!ost_newton_has_energy(newton)) {
        point->value = newton->norm * newton->norm;
        point->slope = -2.0 * point->value;
    }
    return OST_SUCCESS;
}

static int is_low_enough(const OstNewton *newton, const Point *start, const Point *point)
{
    if (!isfinite(point->value))
        return 0;
    if (point->value <= start->value + share * point->length * start->slope)
        return 1;
    if (!ost_newton_has_energy(newton))
        return 0;
    const double hidden = drowned * newton->energy_size;
    return point->value <= start->value + hidden && fabs(point->slope) <= 0.9 * fabs(start->slope);
}

/* The minimiser of the cubic with the values and slopes of both ends, within bounds. */
static double shorten(const Point *start, const Point *point)
{
    const double length = point->length;
    const double secant = 3.0 * (start->value - point->value) / length + start->slope + point->slope;
    const double root = sqrt(fmax(secant * secant - start->slope * point->slope, 0.0));
    double found = length * (1.0 - (point->slope + root - secant) / (point->slope - start->slope + 2.0 * root));
    if (!isfinite(found) || !isfinite(point->value))
        found = least_cut * length;
    return fmin(fmax(found, least_cut * length), most_cut * length);
}

OstStatus ost_newton_search(OstNewton *newton, double *length)
{
    const size_t count = 3 * (size_t)newton->problem->mesh->node_count;
    Point start, point;
    OST_TRY(measure(newton, 0.0, &start));
    *length = 0.0;
    if (!(start.slope < 0.0))
        return OST_SUCCESS;
    double next = 1.0;
    for (int cut = 0; cut <= MOST_CUTS; cut++) {
        for (size_t i = 0; i < count; i++)
            newton->candidate[i] = newton->displacement[i] + next * newton->direction[i];
        OST_TRY(ost_newton_evaluate(newton, newton->candidate));
        OST_TRY(measure(newton, next, &point));
        if (is_low_enough(newton, &start, &point)) {
            memcpy(newton->displacement, newton->candidate, count * sizeof(double));
            *length = next;
            return OST_SUCCESS;
        }
        newton->report.cuts++;
        next = shorten(&start, &point);
    }
    return ost_newton_evaluate(newton, newton->displacement);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/levers.h"
#include "assembly/links/rigid_faces.h"
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

/* There, and without an energy, the slope must fall to this share. */
static const double flatter = 0.9;

/* A step is cut to between these shares of itself. */
static const double least_cut = 0.1, most_cut = 0.5;

/* A step is doubled where the slope at its end is more than this share of that at its beginning. */
static const double steep = 0.5;

enum { MOST_CUTS = 20, MOST_EXTENSIONS = 10 };

/* A whole correction that turns a slender body stretches it, and the next ones take that back. So it is taken even if
 * the energy rises, and judged by where the corrections after it lead; after so many steps in all the search goes back
 * to a shorter one (R. M. Chamberlain and others, The watchdog technique for forcing convergence in algorithms for
 * constrained optimization, Math. Program. Study 16, 1982). */
enum { MOST_TRIALS = 3 };

/* What the search goes by, at one step length: the energy and its slope, or, without an energy, the slope alone: the
 * residual along the direction. */
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
    return OST_SUCCESS;
}

/* The energy that a step must lie below (L. Grippo, F. Lampariello and S. Lucidi, A nonmonotone line search technique
 * for Newton's method, SIAM J. Numer. Anal. 23, 1986): a whole step of a slender body that turns stretches it at first,
 * and the next one takes that back. Where the stiffness was indefinite, the next one may lead elsewhere. */
static double reference(const OstNewton *newton, const Point *start)
{
    double highest = start->value;
    for (int k = 0; k < OST_RECENT && !newton->indefinite; k++)
        highest = fmax(highest, newton->recent[k]);
    return highest;
}

static int is_low_enough(const OstNewton *newton, const Point *start, const Point *point)
{
    if (!isfinite(point->value) || !isfinite(point->slope))
        return 0;
    if (!ost_newton_has_energy(newton))
        return fabs(point->slope) <= flatter * fabs(start->slope);
    if (point->value <= reference(newton, start) + share * point->length * start->slope)
        return 1;
    const double hidden = drowned * newton->energy_size;
    return point->value <= start->value + hidden && fabs(point->slope) <= flatter * fabs(start->slope);
}

/* The minimiser of the cubic with the values and slopes of both ends, within bounds. */
static double shorten(const Point *start, const Point *point)
{
    const double length = point->length;
    const double secant = 3.0 * (start->value - point->value) / length + start->slope + point->slope;
    const double root = sqrt(fmax(secant * secant - start->slope * point->slope, 0.0));
    double found = length * (1.0 - (point->slope + root - secant) / (point->slope - start->slope + 2.0 * root));
    if (point->value == 0.0 && start->value == 0.0) /* no energy: the zero of the slope */
        found = length * start->slope / (start->slope - point->slope);
    if (!isfinite(found) || !isfinite(point->value))
        found = least_cut * length;
    return fmin(fmax(found, least_cut * length), most_cut * length);
}

OstStatus ost_newton_move(const OstNewton *newton, const double *from, const double *direction, double length,
                          double *to)
{
    for (size_t i = 0; i < newton->count; i++)
        to[i] = from[i] + length * direction[i];
    OST_TRY(ost_rigid_faces_move(newton->problem->supports->links, from, direction, length, to));
    return ost_levers_put(newton->problem->supports->links, to);
}

static OstStatus go_to(OstNewton *newton, double length, Point *point)
{
    OST_TRY(ost_newton_move(newton, newton->displacement, newton->direction, length, newton->candidate));
    OST_TRY(ost_newton_evaluate(newton, newton->candidate));
    return measure(newton, length, point);
}

/* Twice as far, as long as the energy falls there nearly as steeply as at first: so it does along a direction of
 * negative curvature, of which the definite stiffness knows nothing. With pressures the slope alone tells, as values
 * hold the work of pressures on volume that a long step changes, and the next one gives back. */
static OstStatus extend(OstNewton *newton, const Point *start, Point *point)
{
    for (int times = 0; times < MOST_EXTENSIONS && point->slope < steep * start->slope; times++) {
        Point next;
        OST_TRY(go_to(newton, 2.0 * point->length, &next));
        const int falls = ost_newton_is_mixed(newton) ? next.slope < steep * start->slope : next.value < point->value;
        if (!falls)
            return go_to(newton, point->length, point);
        *point = next;
    }
    return OST_SUCCESS;
}

/* To the candidate. */
static void move(OstNewton *newton)
{
    const size_t bytes = newton->count * sizeof(double);
    memcpy(newton->from, newton->displacement, bytes);
    memcpy(newton->displacement, newton->candidate, bytes);
    newton->moved = 1;
    newton->recent[newton->step_iterations % OST_RECENT] = newton->energy;
}

/* Where nothing is minimised. On the way residuals may rise a thousandfold and say nothing: load steps are cut back
 * where whole corrections do not converge. */
static OstStatus take_whole(OstNewton *newton, const Point *start, double *length)
{
    Point point;
    OST_TRY(go_to(newton, 1.0, &point));
    if (!isfinite(newton->norm))
        return ost_newton_evaluate(newton, newton->displacement);
    if (newton->leaving && point.value < start->value)
        OST_TRY(extend(newton, start, &point));
    move(newton);
    *length = point.length;
    return OST_SUCCESS;
}

/* Shorter and shorter steps along the correction, from `next` on. */
static OstStatus cut_back(OstNewton *newton, const Point *start, double next, double *length)
{
    Point point;
    for (int cut = 0; cut < MOST_CUTS; cut++) {
        newton->report.cuts++;
        OST_TRY(go_to(newton, next, &point));
        if (is_low_enough(newton, start, &point)) {
            move(newton);
            *length = point.length;
            return OST_SUCCESS;
        }
        next = shorten(start, &point);
    }
    return ost_newton_evaluate(newton, newton->displacement);
}

/* Takes a whole step that is not low enough, on trial. The energies of such states are no measure for later ones. */
static void try_whole(OstNewton *newton, const Point *start, double *length)
{
    OstNewtonTrial *trial = &newton->trial;
    if (trial->steps++ == 0) {
        trial->value = start->value;
        trial->slope = start->slope;
        trial->goal = reference(newton, start) + share * start->slope;
        memcpy(trial->displacement, newton->displacement, newton->count * sizeof(double));
        memcpy(trial->correction, newton->correction,
               3 * (size_t)newton->problem->system->matrix->rows * sizeof(double));
    }
    memcpy(newton->from, newton->displacement, newton->count * sizeof(double));
    memcpy(newton->displacement, newton->candidate, newton->count * sizeof(double));
    newton->moved = 1;
    *length = 1.0;
}

/* Back to where the trial began, and a shorter step from there. */
static OstStatus give_up_trial(OstNewton *newton, double *length)
{
    OstNewtonTrial *trial = &newton->trial;
    const Point start = {0.0, trial->value, trial->slope};
    Point point;
    trial->steps = 0;
    memcpy(newton->displacement, trial->displacement, newton->count * sizeof(double));
    memcpy(newton->correction, trial->correction, 3 * (size_t)newton->problem->system->matrix->rows * sizeof(double));
    OST_TRY(ost_problem_turn(newton->problem, newton->displacement));
    OST_TRY(ost_newton_spread(newton, newton->correction, newton->direction));
    OST_TRY(go_to(newton, 1.0, &point));
    return cut_back(newton, &start, shorten(&start, &point), length);
}

/* A whole step within a trial. */
static OstStatus go_on_trying(OstNewton *newton, const Point *start, double *length)
{
    Point point;
    if (!(start->slope < 0.0))
        return give_up_trial(newton, length);
    OST_TRY(go_to(newton, 1.0, &point));
    if (point.value <= newton->trial.goal) {
        newton->trial.steps = 0;
        move(newton);
        *length = 1.0;
        return OST_SUCCESS;
    }
    if (newton->trial.steps == MOST_TRIALS || !isfinite(point.value))
        return give_up_trial(newton, length);
    try_whole(newton, start, length);
    return OST_SUCCESS;
}

OstStatus ost_newton_search(OstNewton *newton, double *length)
{
    Point start, point;
    OST_TRY(measure(newton, 0.0, &start));
    *length = 0.0;
    if (ost_newton_is_unsymmetric(newton) || ost_newton_is_saddle(newton))
        return take_whole(newton, &start, length);
    if (newton->trial.steps > 0)
        return go_on_trying(newton, &start, length);
    if (!(start.slope < 0.0))
        return ost_newton_evaluate(newton, newton->displacement);
    OST_TRY(go_to(newton, 1.0, &point));
    if (is_low_enough(newton, &start, &point)) {
        if (ost_newton_has_energy(newton))
            OST_TRY(extend(newton, &start, &point));
        move(newton);
        *length = point.length;
        return OST_SUCCESS;
    }
    if (ost_newton_has_energy(newton) && !newton->leaving && isfinite(point.value)) {
        try_whole(newton, &start, length);
        return OST_SUCCESS;
    }
    return cut_back(newton, &start, shorten(&start, &point), length);
}

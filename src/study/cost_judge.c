/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include <limits.h>
#include <math.h>

/* The relative error in the energy norm, over the solver's tolerance: at most the square root of the condition number
 * of the preconditioned matrix, which multigrid keeps small. */
static const double noise_of_tolerance = 10.0;

enum { MOST_ANSWERS = OST_COST_MOST_REFINEMENTS + 1 };

/* A sum that is below this share of its terms is 0 but for what rounding, or the solve, left of them. */
static const double no_sum = 1e-9;

static double scale_of(const OstWatched *watched)
{
    return watched->scale > no_sum * watched->terms ? watched->scale : watched->terms;
}

/* The largest displacement has no watch. */
static int is_positive(const OstWatch *watch)
{
    if (!watch || watch->kind == OST_WATCH_STRAIN_ENERGY || watch->kind == OST_WATCH_LOAD_FACTOR)
        return 1;
    return watch->component == (watch->kind == OST_WATCH_STRESS ? (int)OST_STRESS_MEASURE_VON_MISES : OST_WATCH_LENGTH);
}

/* A quantity by elements of one order: each refinement at its tightest tolerance. */
static OstAnswers collect(const OstCost *cost, int quantity, int order, int *refinement, double *value)
{
    OstAnswers answers = {.order = order,
                          .refinement = refinement,
                          .value = value,
                          .positive = is_positive(cost->quantity[quantity].watch)};
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (run->state != OST_COST_DONE || !ost_cost_is_plain(run) || run->order != order)
            continue;
        if (answers.count > 0 && refinement[answers.count - 1] == run->refinement)
            continue; /* the same refinement, less tightly solved */
        refinement[answers.count] = run->refinement;
        value[answers.count++] = run->watched[quantity].value;
        answers.noise = fmax(answers.noise, noise_of_tolerance * run->tolerance);
        answers.scale = scale_of(&run->watched[quantity]);
    }
    return answers;
}

/* Prefer order 2, unless it has no reference or order 1 extrapolates to a better known limit. An infinite uncertainty
 * of order 2 means that there may be no limit at all: then order 1 is no better. */
static int lower_tells_more(const OstCostReference *lower, const OstCostReference *higher)
{
    if (lower->kind == OST_REFERENCE_NONE || higher->kind == OST_REFERENCE_NONE)
        return higher->kind == OST_REFERENCE_NONE;
    return lower->kind != OST_REFERENCE_FINEST && isfinite(higher->uncertainty) &&
           lower->uncertainty < higher->uncertainty;
}

/* Of the strain energy the run with the least estimated error may tell more than refinements do. */
static void take_estimate(const OstCost *cost, int quantity, OstCostReference *reference)
{
    int best = -1;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        const int is_better = best < 0 || run->estimate < cost->run[best].estimate;
        if (run->state == OST_COST_DONE && !run->other && !isnan(run->watched[quantity].error) && is_better)
            best = i;
    }
    if (best >= 0)
        ost_reference_improve(cost->run[best].watched[quantity].value, cost->run[best].watched[quantity].error, best,
                              reference);
}

/* The case's expected value, if there is one; else what the runs tend to. */
static void choose_reference(OstCost *cost, int quantity)
{
    OstCostReference *reference = &cost->quantity[quantity].reference;
    const OstWatch *watch = cost->quantity[quantity].watch;
    int refinement[2][MOST_ANSWERS];
    double value[2][MOST_ANSWERS];
    OstAnswers answers[2];
    OstCostReference found[2];
    for (int i = 0; i < 2; i++) {
        answers[i] = collect(cost, quantity, i + 1, refinement[i], value[i]);
        ost_reference_of(&answers[i], &found[i]);
    }
    if (watch && !isnan(watch->expected)) {
        ost_reference_of_formula(watch->expected, fmax(answers[0].scale, answers[1].scale), reference);
        return;
    }
    if (answers[1].count == 1 && answers[0].count > 0)
        ost_reference_compare(&found[1], value[0][answers[0].count - 1]);
    *reference = found[!lower_tells_more(&found[0], &found[1])];
    if (watch && watch->kind == OST_WATCH_STRAIN_ENERGY)
        take_estimate(cost, quantity, reference);
}

/* A run that is itself the reference has no known error. */
static double error_of(const OstCost *cost, const OstCostRun *run, int quantity)
{
    const OstCostReference *reference = &cost->quantity[quantity].reference;
    const int is_reference =
        ost_cost_is_plain(run) && run->order == reference->order && run->refinement == reference->finest;
    if (run->state != OST_COST_DONE || reference->kind == OST_REFERENCE_NONE || reference->size <= 0.0)
        return NAN;
    if (reference->kind == OST_REFERENCE_FINEST && is_reference)
        return NAN;
    if (reference->kind == OST_REFERENCE_ESTIMATED && run == &cost->run[reference->run])
        return NAN;
    return fabs(run->watched[quantity].value - reference->value) / reference->size;
}

/* The error that the change from the previous refinement leaves, at the best possible rate of convergence; of an
 * adaptive run, that which it estimates. */
static double least_left(const OstCost *cost, const OstCostRun *run, int quantity)
{
    const OstCostReference *reference = &cost->quantity[quantity].reference;
    const double estimated = run->watched[quantity].error;
    double left = run->accuracy != 0.0 && !isnan(estimated) ? fabs(estimated) : 0.0;
    for (const OstCostRun *coarse = cost->run; coarse < run; coarse++) {
        if (!ost_cost_is_plain(run) || !ost_cost_is_plain(coarse) || coarse->state != OST_COST_DONE ||
            coarse->order != run->order || coarse->tolerance != run->tolerance || coarse->refinement >= run->refinement)
            continue;
        const double change = fabs(run->watched[quantity].value - coarse->watched[quantity].value);
        const double reduction = pow(ost_best_rate_factor(run->order), run->refinement - coarse->refinement);
        left = change / (reduction - 1.0);
    }
    return run->state == OST_COST_DONE && reference->size > 0.0 ? left / reference->size : 0.0;
}

/* Not where another formulation has another limit. Of a linear body under loads the squared error in the norm of the
 * energy is twice what the strain energy lacks. */
static double norm_of(const OstCost *cost, const OstCostRun *run)
{
    for (int q = 0; q < cost->quantity_count; q++) {
        const OstWatch *watch = cost->quantity[q].watch;
        if (!run->other && watch && watch->kind == OST_WATCH_STRAIN_ENERGY &&
            run->error[q] > cost->quantity[q].reference.uncertainty)
            return sqrt(run->error[q]);
    }
    return NAN;
}

void ost_cost_judge(OstCost *cost)
{
    for (int q = 0; q < cost->quantity_count; q++) {
        choose_reference(cost, q);
        for (int i = 0; i < cost->run_count; i++) {
            cost->run[i].error[q] = error_of(cost, &cost->run[i], q);
            cost->run[i].least_error[q] = least_left(cost, &cost->run[i], q);
        }
    }
    for (int i = 0; i < cost->run_count; i++)
        cost->run[i].true_norm = norm_of(cost, &cost->run[i]);
}

/* The finest run of an order below a refinement, at its tightest tolerance, whose error is known. */
static const OstCostRun *finest_of(const OstCost *cost, int quantity, int order, int below)
{
    const OstCostRun *finest = NULL;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (run->state == OST_COST_DONE && ost_cost_is_plain(run) && run->order == order && run->refinement < below &&
            run->error[quantity] > 0.0 && (!finest || run->refinement > finest->refinement))
            finest = run;
    }
    return finest;
}

int ost_cost_next(const OstCost *cost, int quantity, int order, OstCostNext *next)
{
    const OstCostRun *fine = finest_of(cost, quantity, order, INT_MAX);
    const OstCostRun *coarse = fine ? finest_of(cost, quantity, order, fine->refinement) : NULL;
    if (!coarse || !(fine->error[quantity] < coarse->error[quantity]))
        return 0;
    const double steps = fine->refinement - coarse->refinement;
    const double error = pow(fine->error[quantity] / coarse->error[quantity], 1.0 / steps);
    const double seconds = pow(fine->seconds / coarse->seconds, 1.0 / steps);
    *next = (OstCostNext){.order = order,
                          .refinement = fine->refinement + 1,
                          .tolerance = fine->tolerance,
                          .unknowns = (double)fine->unknowns *
                                      pow((double)fine->unknowns / (double)coarse->unknowns, 1.0 / steps),
                          .error = fine->error[quantity] * error,
                          .seconds = fine->seconds * seconds,
                          .bytes = fine->bytes * pow(fine->bytes / coarse->bytes, 1.0 / steps),
                          .error_factor = error,
                          .seconds_factor = seconds};
    return 1;
}

double ost_cost_claim(const OstCost *cost, const OstCostRun *run, int quantity)
{
    const double error = run->state == OST_COST_DONE ? run->error[quantity] : NAN;
    const double known = fmax(run->least_error[quantity], cost->quantity[quantity].reference.uncertainty);
    return isnan(error) ? NAN : fmax(error, known);
}

int ost_cost_cheapest(const OstCost *cost, int quantity, double target)
{
    int cheapest = -1;
    for (int i = 0; i < cost->run_count; i++) {
        const double claim = ost_cost_claim(cost, &cost->run[i], quantity);
        if (!isnan(claim) && claim <= target && (cheapest < 0 || cost->run[i].seconds < cost->run[cheapest].seconds))
            cheapest = i;
    }
    return cheapest;
}

int ost_cost_by_hand(const OstCost *cost, const OstCostRun *asked)
{
    int cheapest = -1;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (run->state == OST_COST_DONE && ost_cost_is_plain(run) && run->true_norm <= asked->accuracy &&
            (cheapest < 0 || run->seconds < cost->run[cheapest].seconds))
            cheapest = i;
    }
    return cheapest;
}

/* The fastest run of all, then the fastest with a smaller error than that, and so on. */
int ost_cost_frontier(const OstCost *cost, int quantity, int *runs)
{
    int count = 0;
    double beat = INFINITY;
    for (;;) {
        int next = -1;
        for (int i = 0; i < cost->run_count; i++) {
            const double claim = ost_cost_claim(cost, &cost->run[i], quantity);
            if (isnan(claim) || !(claim < beat))
                continue;
            const double seconds = cost->run[i].seconds;
            if (next < 0 || seconds < cost->run[next].seconds ||
                (seconds == cost->run[next].seconds && claim < ost_cost_claim(cost, &cost->run[next], quantity)))
                next = i;
        }
        if (next < 0)
            return count;
        beat = ost_cost_claim(cost, &cost->run[next], quantity);
        runs[count++] = next;
    }
}

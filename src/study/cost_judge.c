/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include <math.h>

/* The energy norm of the error is bounded by the residual times the square root of a condition number; this is what
 * multigrid leaves of that. */
static const double noise_of_tolerance = 10.0;

/* The answers of one order to a quantity: each refinement at the tightest tolerance that was reached. */
typedef struct Ladder {
    int count;
    int refinement[OST_COST_MOST_REFINEMENTS + 1];
    double value[OST_COST_MOST_REFINEMENTS + 1];
    double tolerance;
    double scale;
} Ladder;

static void collect(const OstCost *cost, int quantity, int order, Ladder *ladder)
{
    ladder->count = 0;
    ladder->tolerance = ladder->scale = 0.0;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (run->state != OST_COST_DONE || run->order != order)
            continue;
        if (ladder->count > 0 && ladder->refinement[ladder->count - 1] == run->refinement)
            continue; /* a looser one of the same */
        ladder->refinement[ladder->count] = run->refinement;
        ladder->value[ladder->count++] = run->watched[quantity].value;
        ladder->tolerance = fmax(ladder->tolerance, run->tolerance);
        ladder->scale = run->watched[quantity].scale;
    }
}

static void judge_order(const OstCost *cost, int quantity, int order, Ladder *ladder, OstCostReference *found)
{
    collect(cost, quantity, order, ladder);
    const OstAnswers answers = {.order = order,
                                .count = ladder->count,
                                .refinement = ladder->refinement,
                                .value = ladder->value,
                                .noise = noise_of_tolerance * ladder->tolerance,
                                .scale = ladder->scale};
    ost_reference_of(&answers, found);
}

/* Order 1 as it is never tells more than order 2; what it tends to may, where order 2 had less to go on. Order 2 that
 * has no limit is believed. */
static int lower_tells_more(const OstCostReference *lower, const OstCostReference *higher)
{
    if (lower->kind == OST_REFERENCE_NONE || higher->kind == OST_REFERENCE_NONE)
        return higher->kind == OST_REFERENCE_NONE;
    return lower->kind != OST_REFERENCE_FINEST && isfinite(higher->uncertainty) &&
           lower->uncertainty < higher->uncertainty;
}

/* The formula's value where the case has one. */
static void choose_reference(OstCost *cost, int quantity)
{
    Ladder ladder[2];
    OstCostReference found[2];
    for (int i = 0; i < 2; i++)
        judge_order(cost, quantity, i + 1, &ladder[i], &found[i]);
    const OstWatch *watch = cost->quantity[quantity].watch;
    if (watch && !isnan(watch->expected)) {
        ost_reference_of_formula(watch->expected, fmax(ladder[0].scale, ladder[1].scale),
                                 &cost->quantity[quantity].reference);
        return;
    }
    if (ladder[1].count == 1 && ladder[0].count > 0)
        ost_reference_compare(&found[1], ladder[0].value[ladder[0].count - 1]);
    cost->quantity[quantity].reference = found[!lower_tells_more(&found[0], &found[1])];
}

/* The finest answer says nothing about itself. */
static double error_of(const OstCostReference *reference, const OstCostRun *run, int quantity)
{
    const int is_reference = run->order == reference->order && run->refinement == reference->finest;
    if (run->state != OST_COST_DONE || reference->kind == OST_REFERENCE_NONE || reference->size <= 0.0)
        return NAN;
    if (reference->kind == OST_REFERENCE_FINEST && is_reference)
        return NAN;
    return fabs(run->watched[quantity].value - reference->value) / reference->size;
}

/* Of the change from one refinement to the next at least this is left as error. */
static double least_left(const OstCost *cost, const OstCostRun *run, int quantity)
{
    const OstCostReference *reference = &cost->quantity[quantity].reference;
    double left = 0.0;
    for (const OstCostRun *coarse = cost->run; coarse < run; coarse++) {
        if (coarse->state != OST_COST_DONE || coarse->order != run->order || coarse->tolerance != run->tolerance ||
            coarse->refinement >= run->refinement)
            continue;
        const double change = fabs(run->watched[quantity].value - coarse->watched[quantity].value);
        const double reduction = pow(ost_best_rate_factor(run->order), run->refinement - coarse->refinement);
        left = change / (reduction - 1.0);
    }
    return run->state == OST_COST_DONE && reference->size > 0.0 ? left / reference->size : 0.0;
}

void ost_cost_judge(OstCost *cost)
{
    for (int q = 0; q < cost->quantity_count; q++) {
        choose_reference(cost, q);
        for (int i = 0; i < cost->run_count; i++) {
            cost->run[i].error[q] = error_of(&cost->quantity[q].reference, &cost->run[i], q);
            cost->run[i].accident[q] = least_left(cost, &cost->run[i], q);
        }
    }
}

double ost_cost_claim(const OstCost *cost, const OstCostRun *run, int quantity)
{
    const double error = run->state == OST_COST_DONE ? run->error[quantity] : NAN;
    const double known = fmax(run->accident[quantity], cost->quantity[quantity].reference.uncertainty);
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

/* The fastest run that is more exact than the last one found, and so on to the most exact of all. */
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

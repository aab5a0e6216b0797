/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double default_max_seconds = 600.0;

OstCostLadder ost_cost_default_ladder(void)
{
    return (OstCostLadder){.order_count = 2,
                           .refinement_count = 3,
                           .tolerance_count = 3,
                           .order = {1, 2},
                           .refinement = {0, 1, 2},
                           .tolerance = {1e-2, 1e-4, 1e-8},
                           .max_seconds = default_max_seconds};
}

const char *ost_cost_phase_label(OstCostPhase phase)
{
#define PHASE_LABEL(name, label) [name] = label,
    static const char *const labels[] = {OST_COST_PHASE_TABLE(PHASE_LABEL)};
#undef PHASE_LABEL
    return labels[phase];
}

const char *ost_cost_state_word(OstCostState state)
{
    static const char *const words[] = {"waiting", "done", "not run", "failed"};
    return words[state];
}

double ost_cost_target(int number)
{
    static const double targets[OST_COST_TARGETS] = {0.1, 0.03, 0.01, 0.003};
    return targets[number];
}

/* By refinement, then order, then tolerance with the tightest first: what is cheap comes early, and what the reference
 * is made of comes before its looser neighbours. */
static int compare_runs(const void *a, const void *b)
{
    const OstCostRun *x = a;
    const OstCostRun *y = b;
    if (x->refinement != y->refinement)
        return x->refinement - y->refinement;
    if (x->order != y->order)
        return x->order - y->order;
    return (x->tolerance > y->tolerance) - (x->tolerance < y->tolerance);
}

static int is_same(const OstCostRun *a, const OstCostRun *b)
{
    return compare_runs(a, b) == 0;
}

static OstStatus check_ladder(OstContext *ctx, const OstCostLadder *l)
{
    if (l->order_count < 1 || l->refinement_count < 1 || l->tolerance_count < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the ladder needs an order, a refinement and a tolerance at least");
    for (int i = 0; i < l->order_count; i++)
        if (l->order[i] != 1 && l->order[i] != 2)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "elements are of order 1 or 2, not %d", l->order[i]);
    for (int i = 0; i < l->refinement_count; i++)
        if (l->refinement[i] < 0 || l->refinement[i] > OST_COST_MOST_REFINEMENTS)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "a mesh is refined 0 to %d times, not %d",
                             OST_COST_MOST_REFINEMENTS, l->refinement[i]);
    for (int i = 0; i < l->tolerance_count; i++)
        if (!(l->tolerance[i] >= 1e-15 && l->tolerance[i] < 1.0))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "a tolerance is a number from 1e-15 to below 1, not %g",
                             l->tolerance[i]);
    return OST_SUCCESS;
}

/* A rung that was given twice runs once. */
static OstStatus list_runs(OstCost *cost)
{
    const OstCostLadder *l = &cost->ladder;
    OST_TRY(OST_NEW(cost->ctx, &cost->run, l->order_count * l->refinement_count * l->tolerance_count));
    int count = 0;
    for (int o = 0; o < l->order_count; o++)
        for (int r = 0; r < l->refinement_count; r++)
            for (int t = 0; t < l->tolerance_count; t++)
                cost->run[count++] =
                    (OstCostRun){.order = l->order[o], .refinement = l->refinement[r], .tolerance = l->tolerance[t]};
    qsort(cost->run, (size_t)count, sizeof *cost->run, compare_runs);
    for (int i = 0; i < count; i++)
        if (cost->run_count == 0 || !is_same(&cost->run[i], &cost->run[cost->run_count - 1]))
            cost->run[cost->run_count++] = cost->run[i];
    return OST_SUCCESS;
}

static void add_quantity(OstCost *cost, const char *name, const OstWatch *watch)
{
    OstCostQuantity *quantity = &cost->quantity[cost->quantity_count++];
    quantity->name = name;
    quantity->watch = watch;
}

/* The energy, unless it is watched under a name of its own; and what the case watches, or the largest displacement. */
static void list_quantities(OstCost *cost)
{
    const OstCase *c = cost->c;
    int energy_watched = 0;
    for (int w = 0; w < c->watch_count; w++)
        energy_watched |= c->watches[w].kind == OST_WATCH_STRAIN_ENERGY;
    cost->strain_energy.kind = OST_WATCH_STRAIN_ENERGY;
    cost->strain_energy.expected = NAN;
    if (!energy_watched)
        add_quantity(cost, "energy", &cost->strain_energy);
    if (c->watch_count == 0)
        add_quantity(cost, "largest |u|", NULL);
    for (int w = 0; w < c->watch_count; w++) {
        cost->watch[w] = c->watches[w];
        add_quantity(cost, c->watches[w].name, &cost->watch[w]);
    }
}

OstStatus ost_cost_create(const OstCase *c, const OstCostLadder *ladder, OstCost **cost)
{
    OstContext *ctx = c->ctx;
    *cost = NULL;
    OST_TRY(check_ladder(ctx, ladder));
    OstStatus status = OST_NEW(ctx, cost, 1);
    if (status == OST_SUCCESS) {
        (*cost)->ctx = ctx;
        (*cost)->c = c;
        (*cost)->ladder = *ladder;
        (*cost)->measure = ost_cost_measure;
        list_quantities(*cost);
        status = list_runs(*cost);
    }
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_cost_destroy(cost);
    return status;
}

void ost_cost_destroy(OstCost **cost)
{
    if (!*cost)
        return;
    OST_FREE((*cost)->run);
    OST_FREE(*cost);
}

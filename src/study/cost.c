/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const ost_cost_state_word[] = {"waiting", "done", "not run", "failed"};
const char *const ost_cost_formulation_word[] = {"linear", "consistent", "classical"};

const double ost_cost_target[OST_COST_TARGETS] = {0.1, 0.03, 0.01, 0.003, 0.001};

OstCostVariants ost_cost_default_variants(void)
{
    return (OstCostVariants){.order_count = 2,
                             .refinement_count = 3,
                             .tolerance_count = 3,
                             .order = {1, 2},
                             .refinement = {0, 1, 2},
                             .tolerance = {1e-2, 1e-4, 1e-8},
                             .max_seconds = 600.0};
}

typedef enum Kind { PLAIN, FORMULATION, LOAD_STEPS, ADAPTIVE } Kind;

static Kind kind_of(const OstCostRun *run)
{
    return run->accuracy != 0.0 ? ADAPTIVE : run->load_steps > 0 ? LOAD_STEPS : run->other ? FORMULATION : PLAIN;
}

/* By refinement, then order, then tolerance with the tightest first: cheap runs come early, and the tight ones, from
 * which references are made, before the loose ones. Then other formulations, load steps, and adaptive runs, coarse ones
 * first. */
static int compare_runs(const void *a, const void *b)
{
    const OstCostRun *x = a;
    const OstCostRun *y = b;
    if (kind_of(x) != kind_of(y))
        return (int)kind_of(x) - (int)kind_of(y);
    if (x->accuracy != y->accuracy)
        return x->accuracy > y->accuracy ? -1 : 1;
    if (x->load_steps != y->load_steps)
        return x->load_steps - y->load_steps;
    if (x->formulation != y->formulation)
        return (int)x->formulation - (int)y->formulation;
    if (x->refinement != y->refinement)
        return x->refinement - y->refinement;
    if (x->order != y->order)
        return x->order - y->order;
    return (x->tolerance > y->tolerance) - (x->tolerance < y->tolerance);
}

static OstStatus check_variants(OstContext *ctx, const OstCostVariants *v)
{
    if (v->order_count < 1 || v->refinement_count < 1 || v->tolerance_count < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "at least one order, one refinement and one tolerance are needed");
    for (int i = 0; i < v->order_count; i++)
        if (v->order[i] != 1 && v->order[i] != 2)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "elements are of order 1 or 2, not %d", v->order[i]);
    for (int i = 0; i < v->refinement_count; i++)
        if (v->refinement[i] < 0 || v->refinement[i] > OST_COST_MOST_REFINEMENTS)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "a mesh is refined 0 to %d times, not %d",
                             OST_COST_MOST_REFINEMENTS, v->refinement[i]);
    for (int i = 0; i < v->tolerance_count; i++)
        if (!(v->tolerance[i] >= 1e-15 && v->tolerance[i] < 1.0))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "a tolerance is a number from 1e-15 to below 1, not %g",
                             v->tolerance[i]);
    for (int i = 0; i < v->accuracy_count; i++)
        if (!(v->accuracy[i] > 0.0 && v->accuracy[i] < 1.0))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "an accuracy is a number above 0 and below 1, not %g",
                             v->accuracy[i]);
    for (int i = 0; i < v->load_step_count; i++)
        if (v->load_steps[i] < 1 || v->load_steps[i] > 1000)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "load steps are 1 to 1000, not %d", v->load_steps[i]);
    return OST_SUCCESS;
}

/* Each order on the coarsest mesh at the tightest tolerance, by other formulations than the case's, and in more load
 * steps. */
static void list_large_rotations(const OstCost *cost, int *count)
{
    const OstCostVariants *v = &cost->variants;
    OstCostRun run = {.refinement = v->refinement[0], .tolerance = v->tolerance[0]};
    for (int r = 1; r < v->refinement_count; r++)
        run.refinement = v->refinement[r] < run.refinement ? v->refinement[r] : run.refinement;
    for (int t = 1; t < v->tolerance_count; t++)
        run.tolerance = fmin(run.tolerance, v->tolerance[t]);
    for (int o = 0; o < v->order_count; o++) {
        run.order = v->order[o];
        for (int f = 0; f < v->formulation_count; f++)
            if (v->formulation[f] != cost->c->formulation) {
                cost->run[*count] = run;
                cost->run[*count].other = 1;
                cost->run[(*count)++].formulation = v->formulation[f];
            }
        for (int s = 0; s < v->load_step_count; s++) {
            cost->run[*count] = run;
            cost->run[(*count)++].load_steps = v->load_steps[s];
        }
    }
}

/* A combination that occurs twice runs once. */
static OstStatus list_runs(OstCost *cost)
{
    const OstCostVariants *v = &cost->variants;
    const int is_large = cost->c->large_rotation != OST_LARGE_ROTATION_OFF;
    OST_TRY(OST_NEW(cost->ctx, &cost->run,
                    v->order_count *
                            (v->refinement_count * v->tolerance_count + v->formulation_count + v->load_step_count) +
                        v->accuracy_count));
    int count = 0;
    for (int o = 0; o < v->order_count; o++)
        for (int r = 0; r < v->refinement_count; r++)
            for (int t = 0; t < v->tolerance_count; t++)
                cost->run[count++] =
                    (OstCostRun){.order = v->order[o], .refinement = v->refinement[r], .tolerance = v->tolerance[t]};
    if (is_large)
        list_large_rotations(cost, &count);
    for (int i = 0; i < v->accuracy_count; i++)
        cost->run[count++] = (OstCostRun){.refinement = -1, .accuracy = v->accuracy[i]};
    qsort(cost->run, (size_t)count, sizeof *cost->run, compare_runs);
    for (int i = 0; i < count; i++)
        if (cost->run_count == 0 || compare_runs(&cost->run[i], &cost->run[cost->run_count - 1]) != 0)
            cost->run[cost->run_count++] = cost->run[i];
    return OST_SUCCESS;
}

static void add_quantity(OstCost *cost, const char *name, const OstWatch *watch)
{
    cost->quantity[cost->quantity_count++] = (OstCostQuantity){.name = name, .watch = watch};
}

/* The case's quantities of interest, or the largest displacement if it has none; and the strain energy, unless it is
 * among them. */
static void list_quantities(OstCost *cost)
{
    const OstCase *c = cost->c;
    int energy_watched = 0;
    for (int w = 0; w < c->watch_count; w++)
        energy_watched |= c->watches[w].kind == OST_WATCH_STRAIN_ENERGY;
    cost->strain_energy = (OstWatch){.kind = OST_WATCH_STRAIN_ENERGY, .expected = NAN};
    if (!energy_watched)
        add_quantity(cost, "energy", &cost->strain_energy);
    if (c->watch_count == 0)
        add_quantity(cost, "largest |u|", NULL);
    for (int w = 0; w < c->watch_count; w++) {
        cost->watch[w] = c->watches[w];
        add_quantity(cost, c->watches[w].name, &cost->watch[w]);
    }
}

void ost_cost_describe(const OstCostRun *run, char *text, size_t size)
{
    text[0] = 0;
    if (run->other)
        snprintf(text, size, run->formulation == OST_FORMULATION_LINEAR ? "linear theory" : "%s formulation",
                 ost_cost_formulation_word[run->formulation]);
    else if (run->load_steps > 0)
        snprintf(text, size, "at least %d load step%s", run->load_steps, run->load_steps == 1 ? "" : "s");
}

OstStatus ost_cost_create(const OstCase *c, const OstCostVariants *variants, OstCost **cost)
{
    OstContext *ctx = c->ctx;
    *cost = NULL;
    OST_TRY(check_variants(ctx, variants));
    OST_TRY(ost_case_check_finer(c, "To compare meshes"));
    OstStatus status = OST_NEW(ctx, cost, 1);
    if (status == OST_SUCCESS) {
        **cost = (OstCost){.ctx = ctx, .c = c, .variants = *variants, .measure = ost_cost_measure};
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

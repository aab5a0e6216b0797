/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"
#include "fields/stress_measure.h"

/* Do the boundaries watched hold all of a constraint? */
static int holds_all(const OstSelection *watched, const OstSelection *held)
{
    if (watched->kind != OST_SELECT_BOUNDARY || held->kind != OST_SELECT_BOUNDARY)
        return 0;
    for (int b = 0; b < held->boundaries.count; b++)
        if (ost_names_find(&watched->boundaries, held->boundaries.name[b]) < 0)
            return 0;
    return 1;
}

/* Would statics alone give a reaction: that of all there is? */
static int is_static(const OstCase *c, const OstWatch *watch)
{
    int yes = c->spring_count == 0;
    for (int k = 0; k < c->constraint_count; k++)
        yes &= holds_all(&watch->on, &c->constraints[k].on);
    return yes;
}

/* As in solve/reactions/mean_stress.c. */
static int is_linear_mean(const OstWatch *watch)
{
    return watch->kind == OST_WATCH_STRESS && watch->region && watch->take == OST_TAKE_MEAN &&
           (watch->component <= OST_STRESS_MEASURE_31 || watch->component == OST_STRESS_MEASURE_PRESSURE);
}

int ost_plan_reactions(const OstCase *c)
{
    int count = 0;
    for (int w = 0; w < c->watch_count; w++)
        count += c->watches[w].kind == OST_WATCH_REACTION && !is_static(c, &c->watches[w]);
    return count;
}

int ost_plan_adjoints(const OstCase *c, int mixed)
{
    int count = ost_plan_reactions(c);
    for (int w = 0; w < c->watch_count && mixed && c->large_rotation != OST_LARGE_ROTATION_ON; w++)
        count += is_linear_mean(&c->watches[w]);
    if (c->interest > 0 && c->watches[c->interest - 1].kind != OST_WATCH_STRAIN_ENERGY)
        count++;
    return count;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/json_file.h"
#include "study/cost.h"

static json_t *index_json(int index)
{
    return index >= 0 ? json_integer(index) : json_null();
}

/* A formula's value has a source, but no order and no refinement. */
static json_t *reference_json(const OstCostQuantity *quantity)
{
    const OstCostReference *reference = &quantity->reference;
    const int is_formula = reference->kind == OST_REFERENCE_FORMULA;
    return json_pack("{s:s, s:f, s:o, s:f, s:o, s:o, s:s, s:s?}", "kind", ost_reference_kind_word(reference->kind),
                     "value", reference->value, "uncertainty", ost_json_number(reference->uncertainty), "rate",
                     reference->rate, "order", index_json(is_formula ? -1 : reference->order), "finest_refinement",
                     index_json(is_formula ? -1 : reference->finest), "note", reference->note, "source",
                     is_formula ? quantity->watch->source : NULL);
}

/* Runs are given by their index. */
static json_t *cheapest_json(const OstCost *cost, int quantity)
{
    json_t *list = json_array();
    for (int t = 0; t < OST_COST_TARGETS; t++) {
        const double target = ost_cost_target(t);
        json_array_append_new(list, json_pack("{s:f, s:o, s:o}", "error", target, "run",
                                              index_json(ost_cost_cheapest(cost, quantity, target)), "run_for_a_tenth",
                                              index_json(ost_cost_cheapest(cost, quantity, 0.1 * target))));
    }
    return list;
}

static json_t *frontier_json(const OstCost *cost, int quantity)
{
    json_t *frontier = json_array();
    int runs[OST_COST_MOST_RUNS];
    const int count = ost_cost_frontier(cost, quantity, runs);
    for (int i = 0; i < count; i++)
        json_array_append_new(frontier, json_integer(runs[i]));
    return frontier;
}

static json_t *quantities_json(const OstCost *cost)
{
    json_t *quantities = json_array();
    for (int q = 0; q < cost->quantity_count; q++)
        json_array_append_new(quantities, json_pack("{s:s, s:o, s:o, s:o}", "name", cost->quantity[q].name, "reference",
                                                    reference_json(&cost->quantity[q]), "cheapest",
                                                    cheapest_json(cost, q), "frontier", frontier_json(cost, q)));
    return quantities;
}

static json_t *answers_json(const OstCost *cost, const OstCostRun *run)
{
    json_t *answers = json_object();
    for (int q = 0; q < cost->quantity_count; q++)
        json_object_set_new(answers, cost->quantity[q].name,
                            json_pack("{s:o, s:o, s:o}", "value", ost_json_number(run->watched[q].value), "error",
                                      ost_json_number(run->error[q]), "claim",
                                      ost_json_number(ost_cost_claim(cost, run, q))));
    return answers;
}

static json_t *run_json(const OstCost *cost, const OstCostRun *run)
{
    json_t *item = json_pack("{s:i, s:i, s:f, s:s, s:s, s:f}", "order", run->order, "refinement", run->refinement,
                             "tolerance", run->tolerance, "state", ost_cost_state_word(run->state), "reason",
                             run->reason, "predicted_seconds", run->predicted_seconds);
    if (run->state != OST_COST_DONE)
        return item;
    json_t *phases = json_object();
    for (int p = 0; p < OST_COST_PHASES; p++)
        json_object_set_new(phases, ost_cost_phase_label((OstCostPhase)p), json_real(run->phase[p]));
    json_t *more = json_pack("{s:I, s:I, s:i, s:f, s:i, s:f, s:o, s:f, s:o}", "unknowns", (json_int_t)run->unknowns,
                             "tets", (json_int_t)run->tets, "iterations", run->iterations, "residual", run->residual,
                             "repeats", run->repeats, "seconds", run->seconds, "phase_seconds", phases, "bytes",
                             run->bytes, "answers", answers_json(cost, run));
    json_object_update(item, more);
    json_decref(more);
    return item;
}

static json_t *study_json(const OstCost *cost)
{
    json_t *runs = json_array();
    for (int i = 0; i < cost->run_count; i++)
        json_array_append_new(runs, run_json(cost, &cost->run[i]));
    return json_pack("{s:s, s:s, s:i, s:f, s:f, s:o, s:o}", "case", cost->c->path, "title", cost->c->title, "ranks",
                     ost_size(cost->ctx), "max_seconds", cost->variants.max_seconds, "seconds", cost->seconds,
                     "quantities", quantities_json(cost), "runs", runs);
}

OstStatus ost_cost_write_json(const OstCost *cost, const char *path)
{
    if (ost_rank(cost->ctx) != 0)
        return OST_SUCCESS;
    json_t *document = study_json(cost);
    if (!document)
        return OST_RAISE(cost->ctx, OST_CHECK_FAILED,
                         "%s: the cost study cannot be written as JSON (are its title and names UTF-8?)",
                         cost->c->path);
    return ost_json_write(cost->ctx, document, path);
}

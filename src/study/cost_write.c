/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/write_aside.h"

#include <math.h>
#include <stdio.h>

/* Numbers of a run that is done, by their names in CSV and JSON, which are those of OstCostRun, and what makes them
 * JSON. Phases and memory follow. */
#define RUN_NUMBER_TABLE(X)     \
    X(unknowns, json_integer)   \
    X(tets, json_integer)       \
    X(iterations, json_integer) \
    X(residual, json_real)      \
    X(repeats, json_integer)    \
    X(seconds, json_real)

/* --- CSV --- */

/* An empty field where there is no number. */
static void write_number(FILE *file, int known, double number)
{
    ost_csv_number(file, known ? number : NAN);
}

/* By which a run was solved, or is to be. */
static const char *formulation_of(const OstCost *cost, const OstCostRun *run)
{
    const int is_linear =
        run->state == OST_COST_DONE ? !run->newton.used : cost->c->large_rotation == OST_LARGE_ROTATION_OFF;
    const OstFormulation large = run->other ? run->formulation : cost->c->formulation;
    return ost_cost_formulation_word[is_linear ? OST_FORMULATION_LINEAR : large];
}

static void write_heading(FILE *file, const OstCost *cost)
{
#define HEADING(name, make_json) "," #name
    fputs("order,refinement,tolerance,accuracy,formulation,least_load_steps,load_steps,newton_iterations,state,reason,"
          "predicted_seconds" RUN_NUMBER_TABLE(HEADING),
          file);
#undef HEADING
    for (int p = 0; p < OST_STAGES; p++)
        fprintf(file, ",%s_seconds", ost_stage_label[p]);
    fputs(",bytes,estimate,true_norm", file);
    for (int q = 0; q < cost->quantity_count; q++) {
        static const char *const columns[] = {"",       " reference", " reference uncertainty", " reference kind",
                                              " error", " claim"};
        for (size_t c = 0; c < sizeof columns / sizeof *columns; c++) {
            char name[256];
            snprintf(name, sizeof name, "%.200s%s", cost->quantity[q].name, columns[c]);
            fputc(',', file);
            ost_csv_text(file, name);
        }
    }
    fputc('\n', file);
}

static void write_run(FILE *file, const OstCost *cost, const OstCostRun *run)
{
    const int done = run->state == OST_COST_DONE;
    fprintf(file, "%d,%d,%g,%g,%s", run->order, run->refinement, run->tolerance, run->accuracy,
            formulation_of(cost, run));
    write_number(file, run->load_steps > 0, run->load_steps);
    write_number(file, run->newton.used, run->newton.load_steps);
    write_number(file, run->newton.used, run->newton.iterations);
    fprintf(file, ",%s,", ost_cost_state_word[run->state]);
    ost_csv_text(file, run->reason);
    write_number(file, run->predicted_seconds > 0.0, run->predicted_seconds);
#define CELL(name, make_json) write_number(file, done, (double)run->name);
    RUN_NUMBER_TABLE(CELL)
#undef CELL
    for (int p = 0; p < OST_STAGES; p++)
        write_number(file, done, run->phase[p]);
    write_number(file, done, run->bytes);
    write_number(file, done, run->estimate);
    write_number(file, done, run->true_norm);
    for (int q = 0; q < cost->quantity_count; q++) {
        const OstCostReference *reference = &cost->quantity[q].reference;
        write_number(file, done, run->watched[q].value);
        write_number(file, reference->kind != OST_REFERENCE_NONE, reference->value);
        write_number(file, reference->kind != OST_REFERENCE_NONE, reference->uncertainty);
        fprintf(file, ",%s", ost_reference_kind_word[reference->kind]);
        write_number(file, done, run->error[q]);
        write_number(file, done, ost_cost_claim(cost, run, q));
    }
    fputc('\n', file);
}

static OstStatus write_csv(FILE *file, const void *content)
{
    const OstCost *cost = content;
    write_heading(file, cost);
    for (int i = 0; i < cost->run_count; i++)
        write_run(file, cost, &cost->run[i]);
    return OST_SUCCESS;
}

OstStatus ost_cost_write_csv(const OstCost *cost, const char *path)
{
    return ost_rank(cost->ctx) == 0 ? ost_write_aside(cost->ctx, path, write_csv, cost) : OST_SUCCESS;
}

/* --- JSON --- */

static json_t *index_json(int index)
{
    return index >= 0 ? json_integer(index) : json_null();
}

/* A formula's value has a source, but no order and no refinement. */
static json_t *reference_json(const OstCostQuantity *quantity)
{
    const OstCostReference *reference = &quantity->reference;
    const int is_formula = reference->kind == OST_REFERENCE_FORMULA;
    const int is_ladder = !is_formula && reference->kind != OST_REFERENCE_ESTIMATED;
    return json_pack("{s:s, s:f, s:o, s:f, s:o, s:o, s:s, s:s?}", "kind", ost_reference_kind_word[reference->kind],
                     "value", reference->value, "uncertainty", ost_json_number(reference->uncertainty), "rate",
                     reference->rate, "order", index_json(is_ladder ? reference->order : -1), "finest_refinement",
                     index_json(is_ladder ? reference->finest : -1), "note", reference->note, "source",
                     is_formula ? quantity->watch->source : NULL);
}

/* Runs are given by their index. */
static json_t *cheapest_json(const OstCost *cost, int quantity)
{
    json_t *list = json_array();
    for (int t = 0; t < OST_COST_TARGETS; t++) {
        const double target = ost_cost_target[t];
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

static json_t *next_json(const OstCost *cost, int quantity)
{
    json_t *list = json_array();
    OstCostNext next;
    for (int order = 1; order <= 2; order++)
        if (ost_cost_next(cost, quantity, order, &next))
            json_array_append_new(list,
                                  json_pack("{s:i, s:i, s:f, s:f, s:f, s:f, s:f}", "order", order, "refinement",
                                            next.refinement, "tolerance", next.tolerance, "unknowns", next.unknowns,
                                            "error", next.error, "seconds", next.seconds, "bytes", next.bytes));
    return list;
}

static json_t *quantities_json(const OstCost *cost)
{
    json_t *quantities = json_array();
    for (int q = 0; q < cost->quantity_count; q++)
        json_array_append_new(quantities,
                              json_pack("{s:s, s:o, s:o, s:o, s:o}", "name", cost->quantity[q].name, "reference",
                                        reference_json(&cost->quantity[q]), "cheapest", cheapest_json(cost, q),
                                        "frontier", frontier_json(cost, q), "next", next_json(cost, q)));
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
    char more[64];
    ost_cost_describe(run, more, sizeof more);
    json_t *item =
        json_pack("{s:i, s:i, s:f, s:f, s:s, s:i, s:s, s:s, s:s, s:f}", "order", run->order, "refinement",
                  run->refinement, "tolerance", run->tolerance, "accuracy", run->accuracy, "formulation",
                  formulation_of(cost, run), "least_load_steps", run->load_steps, "more", more, "state",
                  ost_cost_state_word[run->state], "reason", run->reason, "predicted_seconds", run->predicted_seconds);
    if (run->state != OST_COST_DONE)
        return item;
    json_t *phases = json_object();
    for (int p = 0; p < OST_STAGES; p++)
        json_object_set_new(phases, ost_stage_label[p], json_real(run->phase[p]));
#define KEY(name, make_json) json_object_set_new(item, #name, make_json(run->name));
    RUN_NUMBER_TABLE(KEY)
#undef KEY
    json_object_set_new(item, "phase_seconds", phases);
    json_object_set_new(item, "bytes", json_real(run->bytes));
    json_object_set_new(item, "levels", json_integer(run->levels));
    json_object_set_new(item, "load_steps", json_integer(run->newton.load_steps));
    json_object_set_new(item, "newton_iterations", json_integer(run->newton.iterations));
    json_object_set_new(item, "estimate", ost_json_number(run->estimate));
    json_object_set_new(item, "true_norm", ost_json_number(run->true_norm));
    if (run->accuracy != 0.0)
        json_object_set_new(item, "by_hand", index_json(ost_cost_by_hand(cost, run)));
    json_object_set_new(item, "answers", answers_json(cost, run));
    return item;
}

static json_t *study_json(const OstCost *cost)
{
    json_t *runs = json_array();
    for (int i = 0; i < cost->run_count; i++)
        json_array_append_new(runs, run_json(cost, &cost->run[i]));
    return json_pack("{s:s, s:s, s:i, s:f, s:f, s:o, s:o, s:o}", "case", cost->c->path, "title", cost->c->title,
                     "ranks", ost_size(cost->ctx), "max_seconds", cost->variants.max_seconds, "seconds", cost->seconds,
                     "warnings", ost_json_warnings(cost->ctx), "quantities", quantities_json(cost), "runs", runs);
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

/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/effects.h"

#include "core/error.h"
#include "core/json_file.h"

#include <math.h>
#include <stdio.h>

enum { LABEL_WIDTH = 34, CELL_WIDTH = 12, CELL_SIZE = 40 };
static const double mebibyte = 1048576.0;

static const char *const state_word[] = {[OST_VARIANT_OFF] = "off",
                                         [OST_VARIANT_SOLVED] = "solved",
                                         [OST_VARIANT_FAILED] = "failed",
                                         [OST_VARIANT_UNMEASURED] = "not measured"};

static void percent(double share, char *text, size_t size)
{
    if (!isfinite(share))
        snprintf(text, size, "-");
    else if (share != 0.0 && share < 1e-6)
        snprintf(text, size, "%.0e %%", 100.0 * share);
    else
        ost_percent(share, text, size);
}

static void print_percent(double share)
{
    char cell[CELL_SIZE];
    percent(share, cell, sizeof cell);
    printf(" %*s", CELL_WIDTH, cell);
}

static void print_run(const OstEffectStudy *study, const char *label, const OstEffectRun *run)
{
    const int is_base = run == &study->base;
    printf("  %-*s", LABEL_WIDTH, label);
    if (run->state != OST_VARIANT_SOLVED) {
        printf(" failed: %s\n", run->reason);
        return;
    }
    printf(" %9.3f s %8.1f MiB", run->meter.seconds, run->meter.bytes / mebibyte);
    for (int w = -2; w < study->c->watch_count && !is_base; w++)
        print_percent(w == -2 ? run->pose : w == -1 ? run->energy : run->watch[w]);
    printf("\n");
}

/* The solved variants whose change is on one side of the accuracy asked for: those that leave an effect out, or the one
 * that puts large rotation in. */
static void print_list(const OstEffectStudy *study, const char *heading, int needed, int puts_in)
{
    int listed = 0;
    for (int v = 0; v < OST_VARIANT_COUNT; v++) {
        const OstEffectRun *run = &study->run[v];
        char most[CELL_SIZE];
        if (run->state != OST_VARIANT_SOLVED || (v == OST_VARIANT_LARGE_ROTATION) != puts_in ||
            (ost_effect_change(study, run) > study->c->relative_error) != needed)
            continue;
        percent(ost_effect_change(study, run), most, sizeof most);
        printf("%s%s (%s)", listed++ ? ", " : heading, ost_effect_label(ost_variant_effect[v]), most);
    }
    if (listed)
        printf("\n");
}

static void print_unmeasured(const OstEffectStudy *study)
{
    int listed = 0;
    for (int v = 0; v < OST_VARIANT_COUNT; v++)
        if (study->run[v].state == OST_VARIANT_UNMEASURED)
            printf("%s%s (%s)", listed++ ? ", " : "Not measured: ", ost_effect_label(ost_variant_effect[v]),
                   study->run[v].reason);
    if (listed)
        printf("\n");
}

/* Which effects the case has no use for, large rotation apart: one of its two variants always is off. */
static void print_off(const OstEffectStudy *study)
{
    int off = 0;
    for (int v = 0; v < OST_VARIANT_COUNT; v++)
        if (study->run[v].state == OST_VARIANT_OFF && ost_variant_effect[v] != OST_EFFECT_LARGE_ROTATION)
            printf("%s%s", off++ ? ", " : "The case does not have: ", ost_effect_label(ost_variant_effect[v]));
    if (off)
        printf("\n");
}

void ost_effect_study_print(const OstEffectStudy *study)
{
    char asked[CELL_SIZE];
    if (ost_rank(study->ctx) != 0)
        return;
    printf("%s: which effects does it call for?\n\n  %-*s %11s %12s %*s %*s", study->c->title, LABEL_WIDTH, "",
           "seconds", "memory", CELL_WIDTH, "pose", CELL_WIDTH, "energy");
    for (int w = 0; w < study->c->watch_count; w++)
        printf(" %*.*s", CELL_WIDTH, CELL_WIDTH, study->c->watches[w].name);
    printf("\n");
    print_run(study, "the case as it is", &study->base);
    for (int v = 0; v < OST_VARIANT_COUNT; v++)
        if (study->run[v].state == OST_VARIANT_SOLVED || study->run[v].state == OST_VARIANT_FAILED)
            print_run(study, ost_variant_label[v], &study->run[v]);
    percent(study->c->relative_error, asked, sizeof asked);
    printf("\nChanges are relative to the case as it is. The accuracy asked for is %s (accuracy: relative_error).\n",
           asked);
    print_list(study, "Needed, as leaving it out changes the answer by more: ", 1, 0);
    print_list(study, "Missing, as putting it in changes the answer by more: ", 1, 1);
    print_list(study, "Could be left out, as it changes the answer by less: ", 0, 0);
    print_list(study, "Rightly left out, as it would change the answer by less: ", 0, 1);
    print_unmeasured(study);
    print_off(study);
}

static json_t *run_json(const OstEffectStudy *study, const OstEffectRun *run)
{
    json_t *item = json_pack("{s:s}", "state", state_word[run->state]);
    if (run->state == OST_VARIANT_FAILED || run->state == OST_VARIANT_UNMEASURED)
        json_object_set_new(item, "reason", ost_json_text(run->reason));
    if (run->state != OST_VARIANT_SOLVED)
        return item;
    json_object_set_new(item, "seconds", json_real(run->meter.seconds));
    json_object_set_new(item, "bytes", json_real(run->meter.bytes));
    json_object_set_new(item, "unknowns", json_integer(run->unknowns));
    json_object_set_new(item, "iterations", json_integer(run->iterations));
    json_object_set_new(item, "large_rotation", json_boolean(run->large_rotation));
    json_t *watch = json_object();
    for (int w = 0; w < study->c->watch_count; w++)
        json_object_set_new(watch, study->c->watches[w].name, ost_json_number(run->watched[w].value));
    json_object_set_new(item, "watch", watch);
    return item;
}

static json_t *variant_json(const OstEffectStudy *study, int v)
{
    const OstEffectRun *run = &study->run[v];
    json_t *item = run_json(study, run);
    json_object_set_new(item, "effect", json_string(ost_effect_label(ost_variant_effect[v])));
    json_object_set_new(item, "variant", json_string(ost_variant_label[v]));
    if (run->state != OST_VARIANT_SOLVED)
        return item;
    json_t *watch = json_object();
    for (int w = 0; w < study->c->watch_count; w++)
        json_object_set_new(watch, study->c->watches[w].name, ost_json_number(run->watch[w]));
    json_object_set_new(item, "change",
                        json_pack("{s:o, s:o, s:o}", "pose", ost_json_number(run->pose), "energy",
                                  ost_json_number(run->energy), "watch", watch));
    json_object_set_new(item, "needed", json_boolean(ost_effect_change(study, run) > study->c->relative_error));
    return item;
}

OstStatus ost_effect_study_write_json(const OstEffectStudy *study, const char *path)
{
    if (ost_rank(study->ctx) != 0)
        return OST_SUCCESS;
    json_t *variants = json_array();
    for (int v = 0; v < OST_VARIANT_COUNT; v++)
        json_array_append_new(variants, variant_json(study, v));
    json_t *document = json_pack("{s:o, s:o, s:i, s:f, s:o, s:o}", "case", ost_json_text(study->c->path), "title",
                                 ost_json_text(study->c->title), "ranks", ost_size(study->ctx), "relative_error",
                                 study->c->relative_error, "base", run_json(study, &study->base), "variants", variants);
    if (!document)
        return OST_RAISE(study->ctx, OST_CHECK_FAILED,
                         "%s: the study of effects cannot be written as JSON (are its title and names UTF-8?)",
                         study->c->path);
    return ost_json_write(study->ctx, document, path);
}

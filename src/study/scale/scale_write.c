/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/json_file.h"
#include "core/write_aside.h"
#include "study/scale/model.h"
#include "study/scale/scale.h"

#include <math.h>
#include <stdio.h>

/* Numbers of a run that is done, by their names in CSV and JSON, which are those of OstScaleRun, and what makes them
 * JSON. */
#define RUN_NUMBER_TABLE(X)     \
    X(unknowns, json_integer)   \
    X(tets, json_integer)       \
    X(iterations, json_integer) \
    X(cycles, json_integer)     \
    X(residual, json_real)      \
    X(repeats, json_integer)    \
    X(levels, json_integer)     \
    X(bytes, json_real)

/* Counts of a rank: mean and most. */
#define RUN_COUNT_TABLE(X) \
    X(memory)              \
    X(nodes)               \
    X(tets_of_rank)        \
    X(work)

/* --- CSV: a line for a run --- */

/* An empty field where there is no number. */
static void write_number(FILE *file, int known, double number)
{
    ost_csv_number(file, known ? number : NAN);
}

static OstStatus write_csv(FILE *file, const void *content)
{
    const OstScale *scale = content;
#define HEADING(name, make_json) "," #name
#define COUNT_HEADING(name) "," #name "_mean," #name "_most"
    fputs("ranks,target,strong,weak,state,reason,crowded" RUN_NUMBER_TABLE(HEADING) RUN_COUNT_TABLE(
              COUNT_HEADING) ",messages_mean,messages_most,message_bytes_mean,message_bytes_most,sums,seconds",
          file);
#undef HEADING
#undef COUNT_HEADING
    for (int s = 0; s < OST_STAGES; s++)
        fprintf(file, ",%s_seconds", ost_stage_label[s]);
    fputc('\n', file);
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *run = &scale->run[i];
        const int done = run->state == OST_SCALE_DONE, timed = done && !run->crowded;
        OstScaleCount messages, bytes;
        ost_scale_sent(run, &messages, &bytes);
        fprintf(file, "%d,%.17g,%d,%d,%s,", run->ranks, run->target, run->is_strong, run->is_weak,
                ost_scale_state_word[run->state]);
        ost_csv_text(file, run->reason);
        fprintf(file, ",%d", run->crowded);
#define CELL(name, make_json) write_number(file, done, (double)run->name);
#define COUNT_CELL(name)                      \
    write_number(file, done, run->name.mean); \
    write_number(file, done, run->name.most);
        RUN_NUMBER_TABLE(CELL)
        RUN_COUNT_TABLE(COUNT_CELL)
#undef CELL
#undef COUNT_CELL
        const double sent[] = {messages.mean, messages.most, bytes.mean, bytes.most, run->iteration.reductions};
        for (size_t n = 0; n < sizeof sent / sizeof sent[0]; n++)
            write_number(file, done, sent[n]);
        write_number(file, timed, run->seconds);
        for (int s = 0; s < OST_STAGES; s++)
            write_number(file, timed, run->stage[s]);
        fputc('\n', file);
    }
    return OST_SUCCESS;
}

OstStatus ost_scale_write_csv(const OstScale *scale, const char *path)
{
    return ost_rank(scale->ctx) == 0 ? ost_write_aside(scale->ctx, path, write_csv, scale) : OST_SUCCESS;
}

/* --- JSON --- */

static json_t *count_json(const OstScaleCount *count)
{
    return json_pack("{s:f, s:f}", "mean", count->mean, "most", count->most);
}

static json_t *work_json(const OstScaleWork *work)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:o, s:o, s:o, s:o}", "unknowns", work->unknowns, "ranks",
                     work->ranks, "visits", work->visits, "exchanges", work->exchanges, "sums", work->reductions,
                     "gathers", work->gathers, "messages", count_json(&work->messages), "bytes",
                     count_json(&work->bytes), "gathered", count_json(&work->gathered), "multiplied",
                     count_json(&work->multiplied));
}

static json_t *forecast_json(const OstScaleForecast *f)
{
    json_t *parts = json_object();
    for (int p = 0; p < OST_SCALE_PARTS; p++)
        json_object_set_new(parts, ost_scale_part_label[p], json_real(f->part[p]));
    return json_pack("{s:f, s:f, s:i, s:f, s:o, s:o, s:o, s:f, s:f, s:o, s:o}", "ranks", f->ranks, "unknowns",
                     f->unknowns, "levels", f->levels, "coarsest", f->coarsest, "seconds", ost_json_number(f->seconds),
                     "parts", parts, "efficiency", ost_json_number(f->efficiency), "messages", f->messages, "bytes",
                     f->bytes, "partition_seconds", ost_json_number(f->partition), "lists_seconds",
                     ost_json_number(f->lists));
}

/* Seconds are null where ranks outnumber the cores. */
static json_t *run_json(const OstScale *scale, const OstScaleRun *run)
{
    json_t *item = json_pack("{s:i, s:f, s:b, s:b, s:s, s:o}", "ranks", run->ranks, "target", run->target, "strong",
                             run->is_strong, "weak", run->is_weak, "state", ost_scale_state_word[run->state], "reason",
                             ost_json_text(run->reason));
    if (run->state != OST_SCALE_DONE)
        return item;
    json_t *stages = json_object(), *levels = json_array();
    for (int s = 0; s < OST_STAGES; s++)
        json_object_set_new(stages, ost_stage_label[s], json_real(run->stage[s]));
    for (int l = 0; l < run->levels; l++)
        json_array_append_new(levels, work_json(&run->level[l]));
#define KEY(name, make_json) json_object_set_new(item, #name, make_json(run->name));
    RUN_NUMBER_TABLE(KEY)
#undef KEY
#define COUNT_KEY(name) json_object_set_new(item, #name, count_json(&run->name));
    RUN_COUNT_TABLE(COUNT_KEY)
#undef COUNT_KEY
    if (run->crowded) {
        json_decref(stages);
        stages = NULL;
    }
    json_object_set_new(item, "engine", json_string(run->engine));
    json_object_set_new(item, "crowded", json_boolean(run->crowded));
    json_object_set_new(item, "seconds", run->crowded ? json_null() : json_real(run->seconds));
    json_object_set_new(item, "stage_seconds", stages ? stages : json_null());
    json_object_set_new(item, "iteration", work_json(&run->iteration));
    json_object_set_new(item, "setup", work_json(&run->setup));
    json_object_set_new(item, "level", levels);
    const OstScaleRun *from = NULL;
    OstScaleForecast check;
    if (ost_scale_check(scale, run, &from, &check))
        json_object_set_new(item, "foretold_here", forecast_json(&check));
    return item;
}

static json_t *network_json(const OstNetwork *network)
{
    return json_pack("{s:s, s:f, s:f, s:f, s:f}", "name", network->name, "latency", network->latency, "bandwidth",
                     network->bandwidth, "memory", network->memory, "ranks", network->ranks);
}

static json_t *forecasts_json(const OstScale *scale, int weak)
{
    const OstScaleRun *base = ost_scale_base(scale);
    OstScaleForecast forecast[OST_SCALE_FORECASTS];
    char words[512] = "";
    json_t *list = json_array();
    if (!base)
        return json_pack("{s:o, s:n}", "iterations", list, "stops_first");
    for (int f = 0; f < OST_SCALE_FORECASTS; f++) {
        const double ranks = ost_scale_foretold[f], unknowns = (double)base->unknowns;
        ost_scale_foretell(base, &scale->variants.network, ranks, weak ? unknowns / base->ranks * ranks : unknowns,
                           &forecast[f]);
        json_array_append_new(list, forecast_json(&forecast[f]));
    }
    ost_scale_first_limit(forecast, OST_SCALE_FORECASTS, words, sizeof words);
    return json_pack("{s:o, s:s}", "iterations", list, "stops_first", words);
}

OstStatus ost_scale_write_json(const OstScale *scale, const char *path)
{
    if (ost_rank(scale->ctx) != 0)
        return OST_SUCCESS;
    json_t *runs = json_array();
    for (int i = 0; i < scale->run_count; i++)
        json_array_append_new(runs, run_json(scale, &scale->run[i]));
    json_t *document =
        json_pack("{s:s, s:s, s:i, s:i, s:f, s:o, s:o, s:o, s:o, s:o}", "case", scale->path, "title", scale->title,
                  "ranks", ost_size(scale->ctx), "cores", scale->cores, "seconds", scale->seconds, "here",
                  network_json(&scale->here), "network", network_json(&scale->variants.network), "strong",
                  forecasts_json(scale, 0), "weak", forecasts_json(scale, 1), "runs", runs);
    if (!document)
        return OST_RAISE(scale->ctx, OST_CHECK_FAILED, "%s: the study cannot be written as JSON (is its title UTF-8?)",
                         scale->path);
    return ost_json_write(scale->ctx, document, path);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/sweep/sweep.h"

#include "adapt/adapt.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "study/watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Values of the keys in the run of this number. */
static void choose_values(const OstSweep *sweep, int number, OstSweepRun *run)
{
    for (int k = sweep->key_count - 1; k >= 0; k--) {
        run->value[k] = sweep->key[k].value[number % sweep->key[k].count];
        number /= sweep->key[k].count;
    }
}

/* The case with the values of a run. */
static OstStatus read_case(const OstSweep *sweep, const OstSweepRun *run, OstCase **c)
{
    OstContext *ctx = sweep->ctx;
    const int common = sweep->text.settings;
    const char **setting = NULL;
    char *made[OST_MOST_SWEEP_KEYS] = {NULL};
    OstStatus status = OST_NEW(ctx, &setting, common + sweep->key_count);
    for (int s = 0; s < common && status == OST_SUCCESS; s++)
        setting[s] = sweep->text.setting[s];
    for (int k = 0; k < sweep->key_count && status == OST_SUCCESS; k++) {
        const size_t size = strlen(sweep->key[k].key) + strlen(run->value[k]) + 2;
        status = OST_NEW(ctx, &made[k], size);
        if (status == OST_SUCCESS)
            snprintf(made[k], size, "%s=%s", sweep->key[k].key, run->value[k]);
        setting[common + k] = made[k];
    }
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS) {
        OstCaseText text = sweep->text;
        text.settings = common + sweep->key_count;
        text.setting = setting;
        text.swept = sweep->key_count;
        status = ost_case_make(ctx, sweep->path, &text, c);
    }
    if (status == OST_SUCCESS && sweep->load_case)
        status = ost_case_pick(c, sweep->load_case);
    for (int k = 0; k < sweep->key_count; k++)
        OST_FREE(made[k]);
    OST_FREE(setting);
    return status;
}

static OstStatus note(const OstSweep *sweep, const OstScene *scene, const OstResult *result, OstSweepRun *run)
{
    OstWatchedValue *watched = NULL;
    OST_TRY(ost_watch_evaluate_all(scene, result, &watched));
    for (int w = 0; w < sweep->watch_count; w++) {
        run->watched[w] = NAN;
        for (int i = 0; i < scene->c->watch_count; i++)
            if (strcmp(scene->c->watches[i].name, sweep->watch[w]) == 0)
                run->watched[w] = watched[i].value;
    }
    OST_FREE(watched);
    run->unknowns = result->unknowns;
    run->largest_displacement = result->largest_displacement;
    run->strain_energy = result->checks.strain_energy;
    run->relative_error = result->answer.known ? result->answer.relative : NAN;
    run->iterations = result->solve.iterations;
    run->newton_iterations = result->newton.iterations;
    return OST_SUCCESS;
}

/* As accurate as the case asks for. */
static OstStatus solve_accurately(const OstSweep *sweep, const OstCase *c, OstSweepRun *run)
{
    OstAdaptLimits limits = {INFINITY, INFINITY};
    OstAdaption *adaption = NULL;
    OST_TRY(ost_memory_free(c->ctx, &limits.bytes));
    OstStatus status = ost_adapt(c, &limits, &adaption);
    OST_THEN(note(sweep, ost_adaption_scene(adaption), ost_adaption_result(adaption), run));
    if (status == OST_SUCCESS && adaption->end != OST_ADAPT_MET) {
        char words[OST_LONGEST_ADAPT_WORDS];
        ost_adaption_words(adaption, words);
        status = OST_RAISE(c->ctx, OST_NOT_CONVERGED, "%s", words);
    }
    ost_adaption_destroy(&adaption);
    return status;
}

static OstStatus solve_once(const OstSweep *sweep, const OstCase *c, OstSweepRun *run)
{
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstStatus status = ost_scene_create(c, &scene);
    OST_THEN(ost_watch_check(scene));
    OST_THEN(ost_scene_solve(scene, &result));
    OST_THEN(note(sweep, scene, result, run));
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return status;
}

static OstStatus name_watches(OstSweep *sweep, const OstCase *c)
{
    for (int w = 0; w < c->watch_count; w++) {
        OST_TRY(ost_copy_string(sweep->ctx, c->watches[w].name, &sweep->watch[w]));
        sweep->watch_count = w + 1;
    }
    return OST_SUCCESS;
}

static OstStatus solve(OstSweep *sweep, int number)
{
    OstSweepRun *run = &sweep->run[number];
    OstCase *c = NULL;
    const double start = ost_seconds();
    choose_values(sweep, number, run);
    OstStatus status = read_case(sweep, run, &c);
    if (status == OST_SUCCESS && c->load_case_count > 0)
        status = OST_RAISE(sweep->ctx, OST_INVALID_USAGE,
                           "%s: there are %d load cases, and a sweep is of one: name it, as in --case %s", c->path,
                           c->load_case_count, c->load_cases[0].name);
    if (status == OST_SUCCESS && number == 0)
        status = ost_agree(sweep->ctx, name_watches(sweep, c));
    OST_THEN(c->asks_error && c->path_steps == 0 ? solve_accurately(sweep, c, run) : solve_once(sweep, c, run));
    ost_case_destroy(&c);
    run->seconds = ost_seconds() - start;
    return status;
}

/* What is wrong with the case itself shows in the first run. */
static OstStatus take_failure(OstSweep *sweep, int number, OstStatus status)
{
    const int is_of_run = status == OST_NOT_CONVERGED || status == OST_CHECK_FAILED || number > 0;
    if (!is_of_run || status == OST_LIBRARY_FAILED || status == OST_INVALID_USAGE)
        return status;
    sweep->failures++;
    ost_warn(sweep->ctx, "run %d of %d has no answer: %s", number + 1, sweep->run_count, ost_error_text(sweep->ctx));
    return ost_agree(sweep->ctx, ost_copy_string(sweep->ctx, ost_error_text(sweep->ctx), &sweep->run[number].failure));
}

OstStatus ost_sweep_run(OstSweep *sweep)
{
    OstContext *ctx = sweep->ctx;
    long runs = 1;
    for (int k = 0; k < sweep->key_count; k++)
        runs *= runs > OST_MOST_SWEEP_RUNS ? 1 : sweep->key[k].count;
    if (runs > OST_MOST_SWEEP_RUNS)
        return OST_RAISE(ctx, OST_INVALID_USAGE, "%s: the values combine to %ld runs or more; at most %d are possible",
                         sweep->path, runs, OST_MOST_SWEEP_RUNS);
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &sweep->run, runs)));
    sweep->run_count = (int)runs;
    for (int r = 0; r < sweep->run_count; r++) {
        char what[64];
        snprintf(what, sizeof what, "sweep: run %d of %d", r + 1, sweep->run_count);
        ost_progress_task(ctx, what, (double)r / sweep->run_count);
        const OstStatus status = solve(sweep, r);
        if (status != OST_SUCCESS)
            OST_TRY(take_failure(sweep, r, status));
    }
    ost_progress_task(ctx, "", -1.0);
    return OST_SUCCESS;
}

void ost_sweep_clear(OstSweep *sweep)
{
    for (int r = 0; sweep->run && r < sweep->run_count; r++)
        OST_FREE(sweep->run[r].failure);
    for (int w = 0; w < sweep->watch_count; w++)
        OST_FREE(sweep->watch[w]);
    OST_FREE(sweep->run);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/sweep/sweep.h"

#include "adapt/adapt.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/gather.h"
#include "orthostat/load_cases.h"
#include "study/forecast/show.h"
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

/* Which column a quantity has; watch_count if none. */
static int find_watch(const OstSweep *sweep, const char *name)
{
    int w = 0;
    while (w < sweep->watch_count && strcmp(sweep->watch[w], name) != 0)
        w++;
    return w;
}

static OstStatus note(const OstSweep *sweep, const OstScene *scene, const OstResult *result, OstSweepRun *run)
{
    OstWatchedValue *watched = NULL;
    OST_TRY(ost_agree(sweep->ctx, OST_NEW(sweep->ctx, &run->watched, sweep->watch_count)));
    OST_TRY(ost_watch_evaluate_all(scene, result, &watched));
    for (int w = 0; w < sweep->watch_count; w++)
        run->watched[w] = NAN;
    for (int i = 0; i < scene->c->watch_count; i++) {
        const int w = find_watch(sweep, scene->c->watches[i].name);
        if (w < sweep->watch_count)
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

/* --- one load case, or the case --- */

static int runs_of_value(const OstSweep *sweep)
{
    return sweep->case_count > 0 ? sweep->case_count : 1;
}

static void name_run(const OstSweep *sweep, int number, size_t size, char *name)
{
    const char *load_case = sweep->run[number].load_case;
    snprintf(name, size, "run %d of %d%s%s", number + 1, sweep->run_count, load_case ? ", load case " : "",
             load_case ? load_case : "");
}

static void show_progress(const OstSweep *sweep, int number, int done)
{
    char name[128], what[160];
    name_run(sweep, number, sizeof name, name);
    snprintf(what, sizeof what, "sweep: %s", name);
    ost_progress_task(sweep->ctx, what, done, sweep->run_count);
}

static OstStatus take_failure(OstSweep *sweep, int number, OstStatus status)
{
    char name[128];
    if (status == OST_SUCCESS || status == OST_LIBRARY_FAILED || status == OST_INVALID_USAGE)
        return status;
    sweep->failures++;
    name_run(sweep, number, sizeof name, name);
    ost_warn(sweep->ctx, "%s has no answer: %s", name, ost_error_text(sweep->ctx));
    return ost_agree(sweep->ctx, ost_copy_string(sweep->ctx, ost_error_text(sweep->ctx), &sweep->run[number].failure));
}

/* --- the load cases of one value --- */

/* On one mesh: as `solve` does, with all that they share. */
static OstStatus solve_together(OstSweep *sweep, const OstCase *c, int first)
{
    OstScene *scene = NULL;
    OstLoadCases *cases = NULL;
    OstStatus status = ost_scene_create(c, &scene);
    OST_THEN(ost_forecast_show(scene));
    OST_THEN(ost_load_cases_create(scene, &cases));
    for (int k = 0; k < c->load_case_count && status == OST_SUCCESS; k++)
        status = ost_watch_check(ost_load_cases_scene(cases, k));
    while (status == OST_SUCCESS && ost_load_cases_left(cases) > 0) {
        OstResult *result = NULL;
        const int number = ost_load_cases_next(cases);
        const OstScene *own = ost_load_cases_scene(cases, number);
        show_progress(sweep, first + number, first + c->load_case_count - ost_load_cases_left(cases));
        status = ost_load_cases_solve(cases, ost_scene_result_fields(own), &result);
        OST_THEN(note(sweep, own, result, &sweep->run[first + number]));
        status = take_failure(sweep, first + number, status);
        ost_result_destroy(&result);
    }
    ost_load_cases_destroy(&cases);
    ost_scene_destroy(&scene);
    return status;
}

static OstStatus solve_each(OstSweep *sweep, const OstCase *c, int first)
{
    OstStatus status = OST_SUCCESS;
    if (!c->asks_error)
        return solve_together(sweep, c, first);
    for (int k = first; k < first + c->load_case_count && status == OST_SUCCESS; k++) {
        show_progress(sweep, k, k);
        status = take_failure(sweep, k, solve_accurately(sweep, c->load_cases[k - first].c, &sweep->run[k]));
    }
    return status;
}

static OstStatus check_load_cases(const OstSweep *sweep, const OstCase *c)
{
    int same = c->load_case_count == sweep->case_count;
    for (int k = 0; same && k < c->load_case_count; k++)
        same = strcmp(c->load_cases[k].name, sweep->cases[k].name) == 0;
    return same ? OST_SUCCESS
                : OST_RAISE(sweep->ctx, OST_INVALID_USAGE, "%s: a sweep cannot change which load cases there are",
                            sweep->path);
}

/* --- all --- */

static OstStatus name_watches(OstSweep *sweep, const OstCase *c)
{
    for (int w = 0; w < c->watch_count; w++) {
        if (find_watch(sweep, c->watches[w].name) < sweep->watch_count)
            continue;
        OST_TRY(OST_RESIZE(sweep->ctx, &sweep->watch, sweep->watch_count + 1));
        sweep->watch[sweep->watch_count] = NULL;
        OST_TRY(ost_copy_string(sweep->ctx, c->watches[w].name, &sweep->watch[sweep->watch_count++]));
    }
    for (int k = 0; k < c->load_case_count; k++)
        OST_TRY(name_watches(sweep, c->load_cases[k].c));
    return OST_SUCCESS;
}

/* The first value that can be read says what is watched. If none can, as where a key does not exist, nothing is run. */
static OstStatus begin(OstSweep *sweep)
{
    OstStatus status = OST_INVALID_INPUT;
    OstSweepRun run = {0};
    for (int number = 0; number < sweep->run_count / runs_of_value(sweep) && status != OST_SUCCESS; number++) {
        OstCase *c = NULL;
        choose_values(sweep, number, &run);
        status = read_case(sweep, &run, &c);
        OST_THEN(ost_agree(sweep->ctx, name_watches(sweep, c)));
        ost_case_destroy(&c);
    }
    if (status == OST_SUCCESS)
        return status;
    OstCase *c = NULL;
    choose_values(sweep, 0, &run);
    return read_case(sweep, &run, &c);
}

/* For the values of the runs from the first on. */
static OstStatus solve(OstSweep *sweep, int first)
{
    OstSweepRun *run = &sweep->run[first];
    OstCase *c = NULL;
    const double start = ost_seconds();
    OstStatus status = read_case(sweep, run, &c);
    OST_THEN(check_load_cases(sweep, c));
    OST_THEN(c->load_case_count > 0                ? solve_each(sweep, c, first)
             : c->asks_error && c->path_steps == 0 ? solve_accurately(sweep, c, run)
                                                   : solve_once(sweep, c, run));
    ost_case_destroy(&c);
    const double share = (ost_seconds() - start) / runs_of_value(sweep);
    for (int k = 0; k < runs_of_value(sweep); k++)
        run[k].seconds = share;
    return status;
}

/* What keeps one from being solved is of all load cases. */
static OstStatus solve_value(OstSweep *sweep, int number)
{
    const int count = runs_of_value(sweep), first = number * count;
    for (int k = 0; k < count; k++) {
        choose_values(sweep, number, &sweep->run[first + k]);
        sweep->run[first + k].load_case = sweep->case_count > 0 ? sweep->cases[k].name : NULL;
    }
    show_progress(sweep, first, first);
    const OstStatus status = solve(sweep, first);
    for (int k = first; status != OST_SUCCESS && k < first + count; k++)
        if (!sweep->run[k].failure)
            OST_TRY(take_failure(sweep, k, status));
    return OST_SUCCESS;
}

/* An interrupted sweep leaves its rows. Seldom enough to cost nothing, by the clock of rank 0. */
static OstStatus keep_what_is_done(const OstSweep *sweep, double *kept)
{
    static const double every = 1.0;
    double since = ost_seconds() - *kept;
    if (!sweep->keep)
        return OST_SUCCESS;
    OST_TRY(ost_broadcast(sweep->ctx, sizeof since, &since));
    if (since < every || sweep->done == sweep->run_count)
        return OST_SUCCESS;
    *kept += since;
    return sweep->keep(sweep, sweep->kept);
}

OstStatus ost_sweep_run(OstSweep *sweep)
{
    OstContext *ctx = sweep->ctx;
    long runs = runs_of_value(sweep);
    for (int k = 0; k < sweep->key_count; k++)
        runs *= runs > OST_MOST_SWEEP_RUNS ? 1 : sweep->key[k].count;
    if (runs > OST_MOST_SWEEP_RUNS)
        return OST_RAISE(ctx, OST_INVALID_USAGE, "%s: the values combine to %ld runs or more; at most %d are possible",
                         sweep->path, runs, OST_MOST_SWEEP_RUNS);
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &sweep->run, runs)));
    sweep->run_count = (int)runs;
    OST_TRY(begin(sweep));
    double kept = 0.0;
    for (int number = 0; number < sweep->run_count / runs_of_value(sweep); number++) {
        OST_TRY(solve_value(sweep, number));
        sweep->done += runs_of_value(sweep);
        OST_TRY(keep_what_is_done(sweep, &kept));
    }
    ost_progress_task(ctx, "", 0, 0);
    return OST_SUCCESS;
}

void ost_sweep_clear(OstSweep *sweep)
{
    for (int r = 0; sweep->run && r < sweep->run_count; r++)
        OST_FREE(sweep->run[r].failure, sweep->run[r].watched);
    OST_FREE_EACH(sweep->watch_count, sweep->watch);
    OST_FREE(sweep->run);
}

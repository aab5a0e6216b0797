/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cases/solve_cases.h"

#include "case/plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/progress.h"
#include "orthostat/load_cases.h"
#include "output/envelope.h"
#include "output/load_case_files.h"
#include "output/probe_files.h"
#include "problem/scene_data.h"
#include "study/forecast/show.h"
#include "study/watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_PATH = 4096 };

/* All load cases, on their way. */
typedef struct Run {
    OstContext *ctx;
    const OstCase *c;
    const OstSolveCases *how;
    OstScene *scene;
    OstStepsFile *steps;       /* NULL: a file for each */
    OstEnvelope *envelope;     /* NULL: none is asked for */
    OstLoadCaseReport *report; /* of each */
    OstStatus failed;          /* how the first that failed did */
    double start;              /* on the clock (ost_seconds) */
} Run;

static int prints(const Run *run)
{
    return ost_log_level(run->ctx) != OST_LOG_QUIET && !(run->how->json && strcmp(run->how->json, "-") == 0);
}

static OstStatus note_failure(Run *run, OstStatus status, OstLoadCaseReport *report)
{
    report->status = status;
    run->failed = run->failed == OST_SUCCESS ? status : run->failed;
    return ost_agree(run->ctx, ost_copy_string(run->ctx, ost_error_text(run->ctx), &report->failure));
}

/* Writes the fields of a result and says what it is. */
static OstStatus take_result(Run *run, const OstScene *scene, const OstResult *result, const OstAdaption *adaption,
                             OstLoadCaseReport *report)
{
    OstContext *ctx = run->ctx;
    char own[LONGEST_PATH];
    const int number = (int)(report - run->report) + 1;
    OstWatchedValue *watched = NULL;
    const int is_answer = result->verdict.count == 0;
    const int writes = result->checks.finite && (is_answer || run->how->keeps);
    ost_load_case_fields_name(run->how->output, report->name, sizeof own, own);
    const char *file = !writes ? NULL : run->steps ? run->how->output : own;
    if (file && run->steps)
        OST_TRY(ost_result_write_step(result, scene->c->output_fields, run->steps, number, report->name));
    else if (file)
        OST_TRY(ost_result_write(result, scene->c->output_fields, file));
    if (is_answer && run->envelope)
        OST_TRY(ost_envelope_take(run->envelope, number - 1, result));
    if (file && scene->c->probe_count > 0)
        OST_TRY(ost_probe_write(scene, result, own));
    OST_TRY(ost_watch_evaluate_all(scene, result, &watched));
    if (prints(run)) {
        ost_summary_print(scene, result, file, own);
        if (ost_rank(ctx) == 0)
            ost_watch_print(watched, scene->c->watch_count);
        if (adaption)
            ost_adaption_print(adaption);
        if (ost_rank(ctx) == 0)
            puts("");
    }
    return ost_agree(ctx, ost_load_case_note(scene, result, watched, adaption, file, report));
}

/* What is wrong with one load case keeps no other from being solved; what is wrong with the machine does. */
static int ends_all(OstStatus status)
{
    return status == OST_OUT_OF_MEMORY || status == OST_LIBRARY_FAILED || status == OST_FILE_FAILED;
}

static OstStatus conclude(Run *run, OstStatus status, const OstScene *scene, const OstResult *result,
                          const OstAdaption *adaption, OstLoadCaseReport *report)
{
    if (status != OST_SUCCESS)
        OST_TRY(note_failure(run, status, report));
    if (ends_all(status))
        return status;
    return result && result->reached ? take_result(run, scene, result, adaption, report) : OST_SUCCESS;
}

static void show_progress(const Run *run, int done, int number)
{
    char what[128];
    snprintf(what, sizeof what, "load case %s, %d of %d", run->c->load_cases[number].name, done + 1,
             run->c->load_case_count);
    ost_progress_task(run->ctx, what, done, run->c->load_case_count);
    ost_log(run->ctx, OST_LOG_VERBOSE, "%s", what);
}

/* On one mesh. */
static OstStatus solve_together(Run *run)
{
    OstLoadCases *cases = NULL;
    OstStatus status = ost_load_cases_create(run->scene, &cases);
    for (int k = 0; k < run->c->load_case_count && status == OST_SUCCESS; k++)
        status = ost_watch_check(ost_load_cases_scene(cases, k));
    while (status == OST_SUCCESS && ost_load_cases_left(cases) > 0) {
        OstResult *result = NULL;
        const int number = ost_load_cases_next(cases);
        const OstScene *scene = ost_load_cases_scene(cases, number);
        show_progress(run, ost_load_cases_count(cases) - ost_load_cases_left(cases), number);
        ost_plan_warn_idle(scene->c, &scene->plan, run->c->load_cases[number].name);
        const OstStatus solved = ost_load_cases_solve(cases, ost_scene_result_fields(scene), &result);
        status = conclude(run, solved, scene, result, NULL, &run->report[number]);
        ost_result_destroy(&result);
    }
    ost_load_cases_destroy(&cases);
    return status;
}

/* The time that is left is shared by the cases that are left: what one does not need others have. */
static OstStatus share_limits(const Run *run, int number, OstAdaptLimits *limits)
{
    double elapsed = ost_seconds() - run->start;
    OST_TRY(ost_max(run->ctx, 1, &elapsed));
    *limits = *run->how->limits;
    limits->seconds = fmax(limits->seconds - elapsed, 0.0) / (run->c->load_case_count - number);
    return OST_SUCCESS;
}

/* Each on a mesh of its own, refined where its error is. */
static OstStatus solve_accurately(Run *run, int number)
{
    OstAdaption *adaption = NULL;
    OstAdaptLimits limits;
    OstLoadCaseReport *report = &run->report[number];
    OST_TRY(share_limits(run, number, &limits));
    OstStatus status = ost_adapt(run->c->load_cases[number].c, &limits, &adaption);
    const OstScene *scene = adaption ? ost_adaption_scene(adaption) : NULL;
    const OstResult *result = adaption ? ost_adaption_result(adaption) : NULL;
    if (scene)
        ost_plan_warn_idle(scene->c, &scene->plan, run->c->load_cases[number].name);
    status = conclude(run, status, scene, result, adaption, report);
    if (status == OST_SUCCESS && report->status == OST_SUCCESS && adaption->end != OST_ADAPT_MET) {
        char words[OST_LONGEST_ADAPT_WORDS];
        ost_adaption_words(adaption, words);
        report->is_short = 1;
        status = note_failure(run, OST_RAISE(run->ctx, OST_NOT_CONVERGED, "%s", words), report);
    }
    ost_adaption_destroy(&adaption);
    return status;
}

static OstStatus solve_into_one_file(Run *run)
{
    OST_TRY(ost_steps_file_create(run->ctx, run->how->output, run->c->load_case_count, &run->steps));
    const OstStatus status = solve_together(run);
    ost_ledger_enter(run->ctx, OST_LEDGER_OUTPUT);
    const OstStatus finished = ost_steps_file_finish(&run->steps);
    ost_ledger_leave(run->ctx);
    return status == OST_SUCCESS ? finished : status;
}

static OstStatus solve_all(Run *run)
{
    if (ost_load_cases_in_one_file(run->c, run->how->output))
        return solve_into_one_file(run);
    if (!run->c->asks_error)
        return solve_together(run);
    for (int k = 0; k < run->c->load_case_count; k++) {
        show_progress(run, k, k);
        OST_TRY(solve_accurately(run, k));
    }
    return OST_SUCCESS;
}

static OstStatus tell(Run *run)
{
    const int count = run->c->load_case_count;
    const OstSolveCases *how = run->how;
    OstLedgerSummary ledger;
    OST_TRY(ost_agree(run->ctx, ost_load_cases_write(run->c, count, run->report, how->output)));
    if (run->envelope)
        OST_TRY(ost_envelope_write(run->envelope, how->output));
    OST_TRY(ost_ledger_summarise(run->ctx, &ledger));
    if (prints(run)) {
        ost_load_cases_print(run->scene, count, run->report, how->output);
        if (run->envelope)
            ost_envelope_print(run->envelope);
        ost_ledger_print(run->scene, &ledger);
    }
    if (!how->json)
        return OST_SUCCESS;
    return ost_agree(run->ctx, ost_load_cases_write_json(run->scene, count, run->report,
                                                         run->envelope ? ost_envelope_json(run->envelope) : NULL,
                                                         &ledger, how->output, how->json));
}

/* The failures of all, in one text. */
static OstStatus raise_failures(const Run *run)
{
    char text[OST_ERROR_TEXT_SIZE] = "";
    char of_none[160] = "", of_short[160] = "";
    const int count = run->c->load_case_count;
    size_t used = 0;
    int none = 0, brief = 0;
    for (int k = 0; k < count; k++) {
        const OstLoadCaseReport *report = &run->report[k];
        if (report->status == OST_SUCCESS)
            continue;
        *(report->is_short ? &brief : &none) += 1;
        if (used < sizeof text)
            used += (size_t)snprintf(text + used, sizeof text - used, "\n  %s: %.500s", report->name, report->failure);
    }
    if (none > 0)
        snprintf(of_none, sizeof of_none, "%d of %d load cases %s no answer%s", none, count, none == 1 ? "has" : "have",
                 run->how->keeps ? "" : ", and nothing of them was written");
    if (brief > 0)
        snprintf(of_short, sizeof of_short, "%s%d of %d load cases %s not as accurate as asked for, and %s written",
                 none > 0 ? "; " : "", brief, count, brief == 1 ? "is" : "are", brief == 1 ? "was" : "were");
    return OST_RAISE(run->ctx, run->failed, "%s: %s%s:%s", run->c->path, of_none, of_short, text);
}

OstStatus ost_solve_cases(const OstCase *c, const OstSolveCases *how)
{
    Run run = {.ctx = c->ctx, .c = c, .how = how, .start = ost_seconds()};
    OstStatus status = ost_agree(c->ctx, OST_NEW(c->ctx, &run.report, c->load_case_count));
    for (int k = 0; k < c->load_case_count && status == OST_SUCCESS; k++) {
        run.report[k].c = c->load_cases[k].c;
        run.report[k].name = c->load_cases[k].name;
    }
    OST_THEN(ost_scene_create(c, &run.scene));
    OST_THEN(ost_forecast_show(run.scene));
    if (c->envelope)
        OST_THEN(ost_envelope_create(c, ost_scene_mesh(run.scene), &run.envelope));
    OST_THEN(solve_all(&run));
    ost_progress_task(c->ctx, "", 0, 0);
    OST_THEN(tell(&run));
    if (status == OST_SUCCESS && run.failed != OST_SUCCESS)
        status = raise_failures(&run);
    for (int k = 0; run.report && k < c->load_case_count; k++)
        ost_load_case_report_release(&run.report[k]);
    OST_FREE(run.report);
    ost_envelope_destroy(&run.envelope);
    ost_scene_destroy(&run.scene);
    return status;
}

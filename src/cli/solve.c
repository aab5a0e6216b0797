/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/adapt.h"
#include "cli/command.h"
#include "cli/destination.h"
#include "cli/solve_path.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/progress.h"
#include "output/path_files.h"
#include "output/probe_files.h"
#include "output/summary.h"
#include "problem/scene_data.h"
#include "study/cases/solve_cases.h"
#include "study/forecast/show.h"
#include "study/watch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Write the fields here (default: the case's output file)", 0},
    {"json", 'j', "FILE", 0, "Write the summary as JSON here; - for standard output", 0},
    {"keep", 'k', 0, 0, "Also write a result that did not converge or that fails a check, marked as such", 0},
    {"resume", 'r', 0, 0, "Go on with a path from its checkpoint, if there is one", 0},
    {"max-time", 't', "SECONDS", 0, "Where an accuracy is asked for: the longest to refine for", 0},
    {"max-memory", 'm', "GIB", 0,
     "Where an accuracy is asked for: the most memory to refine into (default: what is free)", 0},
    {0},
};

static const struct argp solve_argp = {
    options, ost_cli_take, "CASE", "Solves a case and writes its fields for ParaView.", NULL, NULL, NULL};

/* A call of the command. */
typedef struct Run {
    const OstArguments *arguments;
    OstCase *c;
    OstAdaptLimits limits; /* where an accuracy is asked for */
    OstScene *scene;
    OstPath *path;         /* NULL if the case has none */
    OstAdaption *adaption; /* NULL if the case asks for no accuracy; scene and result are its own */
    OstResult *result;
    char output[OST_LONGEST_PATH];
    char file[OST_LONGEST_PATH]; /* of the result: `output`, or beside it that of a path's last step */
} Run;

static OstStatus report(const Run *run)
{
    const OstScene *scene = run->scene;
    OstContext *ctx = scene->ctx;
    const char *json = run->arguments->text['j'];
    const char *file = run->result->checks.finite ? run->file : NULL;
    OstWatchedValue *watched = NULL;
    OstLedgerSummary ledger;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_watch_evaluate_all(scene, run->result, &watched));
    OST_TRY_DONE(ost_ledger_summarise(ctx, &ledger));
    if (ost_log_level(ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(json)) {
        ost_summary_print(scene, run->result, file, file);
        if (ost_rank(ctx) == 0)
            ost_watch_print(watched, scene->c->watch_count);
        if (run->path)
            ost_path_print(scene, run->path, run->output);
        if (run->adaption)
            ost_adaption_print(run->adaption);
        ost_ledger_print(scene, &ledger);
    }
    if (json)
        status = ost_agree(
            ctx, ost_summary_write_json(scene, run->result, run->path, &ledger, watched, file, run->adaption, json));
done:
    OST_FREE(watched);
    return status;
}

/* Numbers that are not finite are never written to the file of fields. */
static OstStatus write_fields(const Run *run)
{
    if (!run->result->checks.finite)
        return OST_SUCCESS;
    OST_TRY(ost_result_write(run->result, run->c->output_fields, run->file));
    return run->c->probe_count > 0 ? ost_probe_write(run->scene, run->result, run->file) : OST_SUCCESS;
}

/* Writes, with --keep, a result that did not converge or failed a check; still returns that failure. */
static OstStatus keep_result(const Run *run, OstStatus failure)
{
    OstContext *ctx = run->c->ctx;
    if (!run->result || !run->result->reached || run->result->verdict.count == 0)
        return failure;
    char text[OST_MOST_OBJECTIONS * (OST_LONGEST_OBJECTION + 2)];
    snprintf(text, sizeof text, "%s", ost_error_text(ctx));
    if (!run->arguments->text['k'])
        return OST_RAISE(ctx, failure, "%s; nothing%s was written (--keep would write it, marked as %s)", text,
                         run->path ? " of this step" : "", ost_result_status(run->result));
    OST_TRY(write_fields(run));
    OST_TRY(report(run));
    return OST_RAISE(ctx, failure, "%s", text);
}

static OstStatus solve_path(Run *run)
{
    const OstStatus status =
        ost_cli_solve_path(run->scene, run->output, run->arguments->text['r'] != NULL, &run->path, &run->result);
    const int failed = status != OST_SUCCESS;
    if (run->path)
        ost_path_step_name(run->output, ost_path_done(run->path) + failed, sizeof run->file, run->file);
    return status == OST_SUCCESS ? report(run) : keep_result(run, status);
}

static OstStatus solve_once(Run *run)
{
    OstStatus status = ost_scene_solve(run->scene, &run->result);
    if (status != OST_SUCCESS)
        return keep_result(run, status);
    OST_TRY(write_fields(run));
    return report(run);
}

/* A number above 0 of an option, or what is taken without it. */
static OstStatus read_limit(const Run *run, char letter, const char *name, double *limit)
{
    const char *text = run->arguments->text[(int)letter];
    char *end = NULL;
    if (!text)
        return OST_SUCCESS;
    *limit = strtod(text, &end);
    return end != text && *end == 0 && *limit > 0.0
               ? OST_SUCCESS
               : OST_RAISE(run->c->ctx, OST_INVALID_USAGE, "--%s takes a number above 0, found '%s'", name, text);
}

static OstStatus read_limits(const Run *run, OstAdaptLimits *limits)
{
    const double gibibyte = 0x1p30;
    *limits = (OstAdaptLimits){INFINITY, INFINITY};
    OST_TRY(ost_memory_free(run->c->ctx, &limits->bytes));
    limits->bytes /= gibibyte;
    OST_TRY(read_limit(run, 't', "max-time", &limits->seconds));
    OST_TRY(read_limit(run, 'm', "max-memory", &limits->bytes));
    limits->bytes *= gibibyte;
    const char *const idle = run->arguments->text['t'] ? "max-time" : run->arguments->text['m'] ? "max-memory" : NULL;
    if (idle && (!run->c->asks_error || run->c->path_steps > 0))
        ost_warn(run->c->ctx, "%s: --%s limits how far meshes are refined, and this case refines none: %s",
                 run->c->path, idle,
                 run->c->path_steps > 0 ? "a path is solved on the mesh as it is"
                                        : "it has no 'accuracy: {relative_error}'");
    return OST_SUCCESS;
}

/* An answer that is not as accurate as it was asked to be is written, and told by the exit status. */
static OstStatus solve_accurately(Run *run)
{
    char words[OST_LONGEST_ADAPT_WORDS];
    const OstStatus status = ost_adapt(run->c, &run->limits, &run->adaption);
    run->scene = run->adaption ? ost_adaption_scene(run->adaption) : NULL;
    run->result = run->adaption ? ost_adaption_result(run->adaption) : NULL;
    if (run->scene)
        ost_plan_warn_idle(run->c, &run->scene->plan, NULL);
    if (status != OST_SUCCESS)
        return keep_result(run, status);
    OST_TRY(write_fields(run));
    OST_TRY(report(run));
    if (run->adaption->end == OST_ADAPT_MET)
        return OST_SUCCESS;
    ost_adaption_words(run->adaption, words);
    return OST_RAISE(run->c->ctx, OST_NOT_CONVERGED, "%s: %s", run->c->path, words);
}

static OstStatus check_files(const Run *run)
{
    const char *json = run->arguments->text['j'];
    if (run->c->path_steps > 0) {
        OST_TRY(ost_cli_check_path_outputs(run->c, run->output));
        return ost_check_outputs(run->c, 1, &json);
    }
    if (run->arguments->text['r'])
        return OST_RAISE(run->c->ctx, OST_INVALID_USAGE, "%s: --resume goes on with a path, and the case has none",
                         run->c->path);
    if (run->c->load_case_count > 0) {
        OST_TRY(ost_check_case_outputs(run->c, run->output));
        return ost_check_outputs(run->c, 1, &json);
    }
    OST_TRY(ost_check_outputs(run->c, 2, (const char *const[]){run->output, json}));
    return ost_check_probe_outputs(run->c, run->output, json);
}

static OstStatus solve_as_given(Run *run)
{
    const OstCase *c = run->c;
    OST_TRY(ost_scene_create(c, &run->scene));
    OST_TRY(ost_forecast_show(run->scene));
    OST_TRY(ost_watch_check(run->scene));
    ost_plan_warn_idle(c, &run->scene->plan, NULL);
    return c->path_steps > 0 ? solve_path(run) : solve_once(run);
}

static OstStatus solve_cases(const Run *run)
{
    const OstSolveCases how = {run->output, run->arguments->text['j'], run->arguments->text['k'] != NULL, &run->limits};
    return ost_solve_cases(run->c, &how);
}

static OstStatus solve(OstContext *ctx, void *input)
{
    Run run = {.arguments = input};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_cli_read(ctx, run.arguments, &run.c));
    OST_TRY_DONE(read_limits(&run, &run.limits));
    OST_TRY_DONE(ost_choose_output(run.c, run.arguments->text['o'], run.output));
    memcpy(run.file, run.output, sizeof run.file);
    OST_TRY_DONE(check_files(&run));
    if (run.c->load_case_count > 0)
        status = solve_cases(&run);
    else
        status = run.c->asks_error && run.c->path_steps == 0 ? solve_accurately(&run) : solve_as_given(&run);
done:
    if (!run.adaption) {
        ost_result_destroy(&run.result);
        ost_scene_destroy(&run.scene);
    }
    ost_path_destroy(&run.path);
    ost_adaption_destroy(&run.adaption);
    ost_case_destroy(&run.c);
    return status;
}

int ost_cli_solve(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run_on_case(ctx, &solve_argp, argc, argv, &arguments, solve);
}

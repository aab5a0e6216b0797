/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/solve_path.h"

#include "cli/destination.h"
#include "core/error.h"
#include "core/memory.h"
#include "output/path_files.h"
#include "output/probe_files.h"
#include "output/summary.h"
#include "study/watch.h"

#include <stdio.h>
#include <unistd.h>

OstStatus ost_cli_check_path_outputs(const OstCase *c, const char *output)
{
    char names[OST_PATH_FILES][OST_LONGEST_PATH], step[OST_LONGEST_PATH];
    const char *files[OST_PATH_FILES];
    for (int f = 0; f < OST_PATH_FILES; f++) {
        ost_path_file_name(output, (OstPathFile)f, sizeof names[f], names[f]);
        files[f] = names[f];
    }
    OST_TRY(ost_check_outputs(c, OST_PATH_FILES, files));
    for (int i = 1; i <= c->path_steps; i++) {
        ost_path_step_name(output, i, sizeof step, step);
        OST_TRY(ost_check_outputs(c, 1, (const char *const[]){step}));
        OST_TRY(ost_check_probe_outputs(c, step, NULL));
    }
    return OST_SUCCESS;
}

static OstStatus note_watched(const OstScene *scene, const OstResult *result, OstPathStep *step)
{
    OstWatchedValue *watched = NULL;
    OST_TRY(ost_watch_evaluate_all(scene, result, &watched));
    for (int w = 0; w < scene->c->watch_count; w++)
        step->note[w] = watched[w].value;
    OST_FREE(watched);
    return OST_SUCCESS;
}

/* The checkpoint comes last: what it says is done has been written. After the last step there is nothing to go on to.
 */
static OstStatus write_step(const OstScene *scene, const char *output, OstPath *path, const OstResult *result)
{
    OstContext *ctx = scene->ctx;
    const int done = ost_path_done(path);
    char name[OST_LONGEST_PATH];
    OST_TRY(note_watched(scene, result, ost_path_step(path, done - 1)));
    ost_path_step_name(output, done, sizeof name, name);
    OST_TRY(ost_result_write(result, scene->c->output_fields, name));
    if (scene->c->probe_count > 0)
        OST_TRY(ost_probe_write(scene, result, name));
    OST_TRY(ost_agree(ctx, ost_path_write_history(scene, path, output)));
    OST_TRY(ost_agree(ctx, ost_path_write_series(ctx, path, output)));
    ost_path_file_name(output, OST_PATH_CHECKPOINT, sizeof name, name);
    return done < ost_path_count(path) ? ost_path_save(path, name) : OST_SUCCESS;
}

/* What the summary says of the last step, it cannot say of the others: tets turned inside out, and jumps. */
static void warn_of_step(OstContext *ctx, int number, double t, const OstResult *result)
{
    char text[OST_LONGEST_WARNING];
    for (int w = OST_WARNINGS_OF_ALL_STEPS; w < OST_WARNINGS; w++)
        if (ost_result_warning(result, w, text))
            ost_warn(ctx, "step %d, at t = %g: %s", number, t, text);
}

static OstStatus take_steps(const OstScene *scene, const char *output, OstPath *path, OstResult **result)
{
    OstContext *ctx = scene->ctx;
    const int count = ost_path_count(path);
    const unsigned fields = ost_scene_result_fields(scene);
    OstStatus status = OST_SUCCESS;
    while (ost_path_done(path) < count && status == OST_SUCCESS) {
        const int number = ost_path_done(path) + 1;
        char what[64];
        snprintf(what, sizeof what, "path: step %d of %d", number, count);
        ost_progress_task(ctx, what, number - 1, count);
        ost_result_destroy(result);
        status = ost_path_advance(path, fields, result);
        if (status != OST_SUCCESS) {
            char text[OST_ERROR_TEXT_SIZE];
            snprintf(text, sizeof text, "%s", ost_error_text(ctx));
            OST_RAISE(ctx, status, "step %d of %d, at t = %g: %s", number, count, scene->c->path_times[number - 1],
                      text);
        }
        OST_THEN(write_step(scene, output, path, *result));
        if (status == OST_SUCCESS && number < count)
            warn_of_step(ctx, number, scene->c->path_times[number - 1], *result);
        if (status == OST_SUCCESS)
            ost_log(ctx, OST_LOG_VERBOSE, "path: step %d of %d done, t = %g, largest |u| %.6g", number, count,
                    ost_path_step(path, number - 1)->t, ost_path_step(path, number - 1)->largest_displacement);
    }
    ost_progress_task(ctx, "", 0, 0);
    return status;
}

/* The steps that are done are listed with those to come. */
static void warn_of_missing_steps(OstContext *ctx, const char *output, int done)
{
    char name[OST_LONGEST_PATH];
    for (int number = 1; number <= done && ost_rank(ctx) == 0; number++) {
        ost_path_step_name(output, number, sizeof name, name);
        if (access(name, F_OK) == 0)
            continue;
        ost_warn(ctx,
                 "step %d of the path is done, but its file %s is not there, which the list of steps names: had the "
                 "output another name before? Without --resume the path begins anew",
                 number, name);
        return;
    }
}

OstStatus ost_cli_solve_path(const OstScene *scene, const char *output, int resumes, OstPath **path, OstResult **result)
{
    OstContext *ctx = scene->ctx;
    char checkpoint[OST_LONGEST_PATH];
    OST_TRY(ost_scene_path(scene, path));
    ost_path_file_name(output, OST_PATH_CHECKPOINT, sizeof checkpoint, checkpoint);
    if (resumes) {
        OST_TRY(ost_path_resume(*path, checkpoint));
        warn_of_missing_steps(ctx, output, ost_path_done(*path));
        ost_log(ctx, OST_LOG_NORMAL,
                ost_path_done(*path) > 0 ? "%s: %d of %d steps are done; the path goes on"
                                         : "%s: no checkpoint, so the path begins anew (%d of %d steps are done)",
                checkpoint, ost_path_done(*path), ost_path_count(*path));
    }
    return take_steps(scene, output, *path, result);
}

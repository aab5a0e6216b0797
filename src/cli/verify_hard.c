/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/verify_hard.h"

#include "cli/destination.h"
#include "cli/script.h"
#include "core/error.h"
#include "study/hard.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static OstStatus list_wanted(OstContext *ctx, const OstHardArguments *arguments, int wanted[OST_HARD_SHAPES])
{
    for (int s = 0; s < OST_HARD_SHAPES; s++)
        wanted[s] = arguments->shape_count == 0;
    for (int i = 0; i < arguments->shape_count; i++) {
        const int shape = ost_hard_find_shape(arguments->shape[i]);
        if (shape < 0) {
            char known[256] = "";
            for (int s = 0; s < OST_HARD_SHAPES; s++)
                snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", s > 0 ? ", " : "",
                         ost_hard_shape_name(s));
            return OST_RAISE(ctx, OST_INVALID_USAGE, "the hard grid has no shape '%s'; it has: %s", arguments->shape[i],
                             known);
        }
        wanted[shape] = 1;
    }
    return OST_SUCCESS;
}

static OstStatus name_readings(OstContext *ctx, const char *folder, char path[OST_LONGEST_PATH])
{
    const int length = snprintf(path, OST_LONGEST_PATH, "%s/hard.json", folder);
    if (length < 0 || length >= OST_LONGEST_PATH - 16)
        return OST_RAISE(ctx, OST_INVALID_USAGE, "the path of the folder is too long: %.200s...", folder);
    if (ost_rank(ctx) == 0 && mkdir(folder, 0777) != 0 && errno != EEXIST)
        return OST_RAISE(ctx, OST_FILE_FAILED, "cannot make the folder '%s': %s", folder, strerror(errno));
    return OST_SUCCESS;
}

/* The grid takes a while: where it goes is looked at first. */
static OstStatus check_destinations(OstContext *ctx, const OstHardArguments *arguments, char readings[OST_LONGEST_PATH])
{
    static char name[] = "hard grid";
    const OstCase nothing = {.ctx = ctx, .path = name};
    const char *paths[] = {arguments->json, NULL};
    if (arguments->picture) {
        OST_TRY(ost_agree(ctx, name_readings(ctx, arguments->picture, readings)));
        paths[1] = readings;
    }
    return ost_check_outputs(&nothing, 2, paths);
}

static OstStatus report_all(const OstHardReport *report, const OstHardArguments *arguments, const char *readings)
{
    const int to_output = arguments->json && strcmp(arguments->json, "-") == 0;
    if (ost_log_level(report->ctx) != OST_LOG_QUIET && !to_output)
        ost_hard_print(report);
    if (arguments->json)
        OST_TRY(ost_hard_write_json(report, arguments->json));
    if (!arguments->picture)
        return OST_SUCCESS;
    OST_TRY(ost_hard_write_json(report, readings));
    return ost_rank(report->ctx) == 0 ? ost_cli_run_script(report->ctx, "plot-hard", readings, arguments->picture)
                                      : OST_SUCCESS;
}

OstStatus ost_cli_verify_hard(OstContext *ctx, const OstHardArguments *arguments, int *passed)
{
    int wanted[OST_HARD_SHAPES];
    char readings[OST_LONGEST_PATH];
    OstHardReport *report = NULL;
    *passed = 0;
    OST_TRY(list_wanted(ctx, arguments, wanted));
    OST_TRY(check_destinations(ctx, arguments, readings));
    OST_TRY(ost_hard_run(ctx, wanted, arguments->quick, &report));
    *passed = ost_hard_passed(report);
    const OstStatus status = ost_agree(ctx, report_all(report, arguments, readings));
    ost_hard_report_destroy(&report);
    return status;
}

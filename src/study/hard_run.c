/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "study/hard.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The stated error is an estimate; it may be less than the error by this factor, and no more. */
static const double slack = 3.0;

const double ost_hard_hopeless = 0.1;

/* Words that the reason for refusing a flawed point must hold. */
static const char *const reason_word[OST_HARD_FLAWS] = {
    [OST_HARD_SOUND] = "",         [OST_HARD_BEYOND_BORDER] = "Stable up to", [OST_HARD_NU_HALF] = "-1 < nu < 0.5",
    [OST_HARD_LOOSE] = "can turn", [OST_HARD_INVERTED] = "is inverted",       [OST_HARD_NOT_A_NUMBER] = "not finite",
};

static void take_reason(OstHardReading *reading, const OstContext *ctx, OstStatus status)
{
    reading->status = status;
    snprintf(reading->reason, sizeof reading->reason, "%s", status == OST_SUCCESS ? "" : ost_error_text(ctx));
}

static void take_result(const OstResult *result, OstHardReading *reading)
{
    reading->unknowns = result->unknowns;
    reading->recipe = result->solve.recipe;
    reading->iterations = result->solve.iterations;
    reading->steps = result->solve.steps;
    reading->residual = result->solve.relative_residual;
    reading->rounding_limited = result->solve.rounding_limited;
    reading->stated_error = result->solve.error_estimate > 0.0 ? result->solve.error_estimate : NAN;
}

static OstStatus solve(OstScene *scene, OstResult **result, OstHardReading *reading)
{
    const double start = ost_seconds();
    const OstStatus status = ost_scene_solve(scene, result);
    reading->seconds += ost_seconds() - start;
    take_reason(reading, scene->ctx, status);
    if (*result)
        take_result(*result, reading);
    return status;
}

/* A flawed point is refused as bad input, with a reason that names the flaw. */
static void judge_flawed(OstHardReading *reading)
{
    const int named = strstr(reading->reason, reason_word[reading->point.flaw]) != NULL;
    if (reading->status == OST_SUCCESS)
        reading->outcome = OST_HARD_FALSE;
    else
        reading->outcome = reading->status == OST_INVALID_INPUT && named ? OST_HARD_REFUSED : OST_HARD_GIVEN_UP;
}

static void condemn(OstHardReading *reading, OstHardOutcome outcome, const char *why)
{
    reading->outcome = outcome;
    if (!reading->reason[0])
        snprintf(reading->reason, sizeof reading->reason, "%s", why);
}

/* Is the answer as near to the direct solution as the program says? Where it says nothing, as the residual allows. */
static int is_true(const OstHardReading *reading)
{
    const OstHardTruth *truth = &reading->truth;
    const double allowed = isnan(reading->stated_error) ? truth->amplification * (reading->residual + truth->floor)
                                                        : reading->stated_error;
    return truth->error <= slack * allowed;
}

static void judge(OstHardReading *reading)
{
    const OstHardTruth *truth = &reading->truth;
    const int hopeless_case = truth->indefinite || truth->rounded > ost_hard_hopeless;
    reading->digits = truth->known ? fmin(-log10(truth->error), 16.0) : NAN;
    if (reading->status != OST_SUCCESS)
        reading->outcome = hopeless_case ? OST_HARD_REFUSED : OST_HARD_GIVEN_UP;
    else if (!truth->known)
        condemn(reading, OST_HARD_FALSE, "solved, where a direct solution cannot be had");
    else if (!is_true(reading))
        condemn(reading, OST_HARD_FALSE, "further from the direct solution than stated");
    else
        reading->outcome = reading->rounding_limited ? OST_HARD_SOLVED_TO_ROUNDING : OST_HARD_SOLVED;
}

static OstStatus solve_sound(OstScene *scene, OstHardReading *reading)
{
    OstResult *result = NULL;
    solve(scene, &result, reading);
    OstStatus status = ost_hard_find_truth(scene, result, &reading->truth);
    ost_result_destroy(&result);
    if (status == OST_NOT_CONVERGED || status == OST_INVALID_INPUT) /* no factors: no truth */
        status = OST_SUCCESS;
    if (status == OST_SUCCESS)
        judge(reading);
    return status;
}

/* Is this a failure of the point, and not of the grid? */
static int concerns_point(OstStatus status)
{
    return status == OST_INVALID_INPUT || status == OST_NOT_CONVERGED || status == OST_CHECK_FAILED;
}

static OstStatus read_point(OstContext *ctx, const OstHardPoint *point, OstHardReading *reading)
{
    OstHardCase hard;
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstStatus status = ost_agree(ctx, ost_hard_make_case(ctx, point, &hard));
    if (status == OST_SUCCESS)
        status = ost_hard_make_chunk(point, &hard.c, &chunk);
    if (status == OST_SUCCESS)
        status = ost_scene_create_on(&hard.c, &chunk, &scene);
    take_reason(reading, ctx, status);
    if (point->flaw != OST_HARD_SOUND) {
        if (status == OST_SUCCESS)
            status = solve(scene, &result, reading);
        judge_flawed(reading);
    } else if (status == OST_SUCCESS)
        status = solve_sound(scene, reading);
    else
        reading->outcome = OST_HARD_GIVEN_UP;
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return concerns_point(status) ? OST_SUCCESS : status;
}

OstStatus ost_hard_read(OstContext *ctx, const OstHardPoint *point, OstHardReading *reading)
{
    const OstLogLevel level = ost_log_level(ctx);
    *reading = (OstHardReading){.point = *point, .residual = NAN, .digits = NAN};
    reading->truth = (OstHardTruth){0, 0, NAN, NAN, NAN, NAN, NAN, NAN};
    ost_log_set_level(ctx, OST_LOG_QUIET);
    const OstStatus status = read_point(ctx, point, reading);
    ost_log_set_level(ctx, level);
    return status;
}

OstStatus ost_hard_run(OstContext *ctx, const int wanted[OST_HARD_SHAPES], int quick, OstHardReport **out)
{
    OstHardReport *report = NULL;
    OstHardPoint *points = NULL;
    const double start = ost_seconds();
    OstStatus status = OST_NEW(ctx, &report, 1);
    if (status == OST_SUCCESS) {
        report->ctx = ctx;
        report->quick = quick;
        status = ost_hard_points(ctx, wanted, quick, &report->count, &points);
    }
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &report->reading, report->count);
    status = ost_agree(ctx, status);
    for (int i = 0; status == OST_SUCCESS && i < report->count; i++) {
        char what[160];
        ost_hard_describe(&points[i], what, sizeof what);
        ost_progress(ctx, what, (double)i / report->count);
        status = ost_hard_read(ctx, &points[i], &report->reading[i]);
        ost_log(ctx, OST_LOG_VERBOSE, "%s: %s, %d iterations, %.1f digits %s", what,
                ost_hard_outcome_name[report->reading[i].outcome], report->reading[i].iterations,
                report->reading[i].digits, report->reading[i].reason);
    }
    ost_progress(ctx, "", -1.0);
    OST_FREE(points);
    if (status == OST_SUCCESS)
        report->seconds = ost_seconds() - start;
    else
        ost_hard_report_destroy(&report);
    *out = report;
    return status;
}

void ost_hard_report_destroy(OstHardReport **report)
{
    if (!*report)
        return;
    OST_FREE((*report)->reading);
    OST_FREE(*report);
}

int ost_hard_passed(const OstHardReport *report)
{
    int failed = 0;
    for (int i = 0; i < report->count; i++)
        failed += report->reading[i].outcome == OST_HARD_GIVEN_UP || report->reading[i].outcome == OST_HARD_FALSE;
    return failed == 0;
}

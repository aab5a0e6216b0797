/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "hard_grid/grid.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The stated error is an estimate: it may be less than the error by the first factor and more by the second, and no
 * more. An error below the last is no error: displacements are rounded. */
static const double least_stated = 1.0 / 3.0, most_stated = 1e3, no_error = 1e-15;

/* Of residuals as they are stated and in 64 bits; below the second a difference is no matter. */
static const double same_residual = 3.0, wanted_residual = 1e-8;

/* A body at size is factored only where its residual does not tell: up to so many unknowns, to judge an answer that
 * rounding limits; or, up to the second, whether it is refused rightly. */
static const OstGlobal rounded_size = 10000, refused_size = 100000;

const double hard_hopeless = 0.1;

/* Words that the reason for refusing a flawed point must hold. */
static const char *const reason_word[HARD_FLAWS] = {
    [HARD_SOUND] = "",         [HARD_BEYOND_BORDER] = "Stable up to", [HARD_NU_HALF] = "nu = 1/2",
    [HARD_LOOSE] = "can turn", [HARD_INVERTED] = "is inverted",       [HARD_NOT_A_NUMBER] = "not finite",
};

static void take_reason(HardReading *reading, const OstContext *ctx, OstStatus status)
{
    reading->status = status;
    snprintf(reading->reason, sizeof reading->reason, "%s", status == OST_SUCCESS ? "" : ost_error_text(ctx));
}

static void take_result(const OstResult *result, HardReading *reading)
{
    reading->unknowns = result->unknowns;
    reading->method = result->solve.method;
    reading->iterations = result->solve.iterations;
    reading->steps = result->solve.steps;
    reading->residual = result->solve.relative_residual;
    reading->tet_residual = result->checks.relative_residual;
    reading->rounding_limited = result->solve.rounding_limited;
    reading->stated_error = result->checks.displacement_error;
    reading->stated_forces = result->checks.force_error;
}

static OstStatus solve(OstScene *scene, OstResult **result, HardReading *reading)
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
static void judge_flawed(HardReading *reading)
{
    const int named = strstr(reading->reason, reason_word[reading->point.flaw]) != NULL;
    if (reading->status == OST_SUCCESS)
        reading->outcome = HARD_FALSE;
    else
        reading->outcome = reading->status == OST_INVALID_INPUT && named ? HARD_REFUSED : HARD_GIVEN_UP;
}

static void fail(HardReading *reading, HardOutcome outcome, const char *why)
{
    reading->outcome = outcome;
    if (!reading->reason[0])
        snprintf(reading->reason, sizeof reading->reason, "%s", why);
}

static int states(double stated, double error)
{
    return stated >= least_stated * error && stated <= most_stated * fmax(error, no_error);
}

int hard_states_its_error(const HardReading *reading)
{
    const HardErrors *off = &reading->truth.off;
    if (!off->known)
        return 1;
    return states(reading->stated_error, off->displacement) &&
           states(reading->stated_forces, fmax(off->reaction, off->stress));
}

/* Where the tets' equations cannot be solved, or nothing is stated: is the answer as near to the direct solution of the
 * rounded ones as the residual allows? */
static int is_true(const HardReading *reading)
{
    const HardTruth *truth = &reading->truth;
    if (truth->off.known && !isnan(reading->stated_error))
        return hard_states_its_error(reading);
    return truth->error <= truth->amplification * (reading->residual + truth->floor) / least_stated;
}

static int is_hopeless(const HardTruth *truth)
{
    return truth->indefinite || truth->rounded > hard_hopeless;
}

static void judge(HardReading *reading)
{
    const HardTruth *truth = &reading->truth;
    const double error = truth->off.known ? truth->off.displacement : truth->error;
    reading->digits = truth->known ? fmin(-log10(error), 16.0) : NAN;
    if (reading->status != OST_SUCCESS)
        reading->outcome = is_hopeless(truth) ? HARD_REFUSED : HARD_GIVEN_UP;
    else if (!truth->known)
        fail(reading, HARD_FALSE, "solved, but there is no direct solution");
    else if (!is_true(reading))
        fail(reading, HARD_FALSE, "its errors are not as stated");
    else
        reading->outcome = reading->rounding_limited ? HARD_SOLVED_TO_ROUNDING : HARD_SOLVED;
}

/* As above; where the tets' equations have not settled, the displacement alone, by the rounded ones. */
static int is_true_mixed(const HardReading *reading)
{
    if (reading->truth.off.known)
        return hard_states_its_error(reading);
    return states(reading->stated_error, reading->truth.error);
}

static void judge_mixed(HardReading *reading)
{
    const HardTruth *truth = &reading->truth;
    const double error = truth->off.known ? truth->off.displacement : truth->error;
    reading->digits = truth->known ? fmin(-log10(error), 16.0) : NAN;
    if (reading->status != OST_SUCCESS)
        reading->outcome = is_hopeless(truth) ? HARD_REFUSED : HARD_GIVEN_UP;
    else if (!truth->known)
        fail(reading, HARD_FALSE, "solved, but there is no direct solution");
    else if (!is_true_mixed(reading))
        fail(reading, HARD_FALSE, "its errors are not as stated");
    else
        reading->outcome = reading->rounding_limited ? HARD_SOLVED_TO_ROUNDING : HARD_SOLVED;
}

/* At size: is the residual in the tets' equations as small as it is said to be? */
static void judge_residual(HardReading *reading)
{
    const double residual = reading->truth.residual;
    reading->digits = fmin(-log10(reading->stated_error), 16.0);
    if (reading->status != OST_SUCCESS)
        reading->outcome = HARD_GIVEN_UP;
    else if (!(residual <= same_residual * fmax(reading->tet_residual, wanted_residual)))
        fail(reading, HARD_FALSE, "its residual is not as stated");
    else
        reading->outcome = reading->rounding_limited ? HARD_SOLVED_TO_ROUNDING : HARD_SOLVED;
}

/* At size, of a refusal: no factors are needed where a soft motion shows that rounding leaves no digit. */
static OstStatus judge_refusal(const OstScene *scene, HardReading *reading)
{
    OST_TRY(hard_find_singular(scene, &reading->truth));
    reading->digits = NAN;
    if (is_hopeless(&reading->truth))
        reading->outcome = HARD_REFUSED;
    return OST_SUCCESS;
}

/* Is this a failure of the point, and not of the grid? */
static int concerns_point(OstStatus status)
{
    return status == OST_INVALID_INPUT || status == OST_NOT_CONVERGED || status == OST_CHECK_FAILED;
}

static OstStatus compare(const OstScene *scene, const OstResult *result, HardReading *reading)
{
    const int mixed = ost_field_is_mixed(scene->field);
    OstStatus status =
        mixed ? hard_find_mixed_truth(scene, result, &reading->truth) : hard_find_truth(scene, result, &reading->truth);
    if (concerns_point(status) || status == OST_OUT_OF_MEMORY) /* no factors: nothing to compare with */
        status = OST_SUCCESS;
    if (status == OST_SUCCESS && mixed)
        judge_mixed(reading);
    else if (status == OST_SUCCESS)
        judge(reading);
    return status;
}

static int needs_factors(const HardReading *reading)
{
    const OstGlobal size = reading->point.size;
    if (size == 0)
        return 1;
    if (reading->status != OST_SUCCESS)
        return reading->outcome != HARD_REFUSED && size <= refused_size;
    return size <= rounded_size && reading->outcome == HARD_SOLVED_TO_ROUNDING;
}

OstStatus hard_solve_scene(OstScene *scene, HardReading *reading)
{
    const OstGlobal size = reading->point.size;
    OstResult *result = NULL;
    OstStatus status = OST_SUCCESS;
    solve(scene, &result, reading);
    if (size > 0 && result && ost_field_is_mixed(scene->field))
        status = hard_find_mixed_residual(scene, result, &reading->truth);
    else if (size > 0 && result)
        status = hard_find_residual(scene, result, &reading->truth);
    if (size > 0 && status == OST_SUCCESS)
        judge_residual(reading);
    if (status == OST_SUCCESS && size > 0 && reading->status != OST_SUCCESS)
        status = judge_refusal(scene, reading);
    if (status == OST_SUCCESS && needs_factors(reading))
        status = compare(scene, result, reading);
    ost_result_destroy(&result);
    return status;
}

static OstStatus read_point(OstContext *ctx, const HardPoint *point, HardReading *reading)
{
    HardCase hard;
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstStatus status = ost_agree(ctx, hard_make_case(ctx, point, &hard));
    if (status == OST_SUCCESS)
        status = hard_make_chunk(point, &hard.c, &chunk);
    if (status == OST_SUCCESS)
        status = ost_scene_create_on(&hard.c, &chunk, &scene);
    take_reason(reading, ctx, status);
    if (point->flaw != HARD_SOUND) {
        if (status == OST_SUCCESS)
            status = solve(scene, &result, reading);
        judge_flawed(reading);
    } else if (status == OST_SUCCESS)
        status = hard_solve_scene(scene, reading);
    else
        reading->outcome = HARD_GIVEN_UP;
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return concerns_point(status) ? OST_SUCCESS : status;
}

OstStatus hard_read(OstContext *ctx, const HardPoint *point, HardReading *reading)
{
    const OstLogLevel level = ost_log_level(ctx);
    *reading = (HardReading){.point = *point, .residual = NAN, .digits = NAN};
    reading->truth = (HardTruth){0, 0, NAN, {0, NAN, NAN, NAN}, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    if (level != OST_LOG_VERBOSE)
        ost_log_set_level(ctx, OST_LOG_QUIET);
    const OstStatus status = read_point(ctx, point, reading);
    ost_log_set_level(ctx, level);
    return status;
}

OstStatus hard_run(OstContext *ctx, const HardRun *run, HardReport **out)
{
    HardReport *report = NULL;
    HardPoint *points = NULL;
    const double start = ost_seconds();
    OstStatus status = OST_NEW(ctx, &report, 1);
    if (status == OST_SUCCESS) {
        report->ctx = ctx;
        report->run = *run;
        status = hard_points(ctx, run, &report->count, &points);
    }
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &report->reading, report->count);
    status = ost_agree(ctx, status);
    for (int i = 0; status == OST_SUCCESS && i < report->count; i++) {
        char what[160];
        hard_describe(&points[i], what, sizeof what);
        ost_progress(ctx, what, (double)i / report->count);
        status = hard_read(ctx, &points[i], &report->reading[i]);
        ost_log(ctx, OST_LOG_VERBOSE, "%s: %s, %d iterations, %.1f digits %s", what,
                hard_outcome_name[report->reading[i].outcome], report->reading[i].iterations, report->reading[i].digits,
                report->reading[i].reason);
    }
    ost_progress(ctx, "", -1.0);
    OST_FREE(points);
    if (status == OST_SUCCESS)
        report->seconds = ost_seconds() - start;
    else
        hard_report_destroy(&report);
    *out = report;
    return status;
}

void hard_report_destroy(HardReport **report)
{
    if (!*report)
        return;
    OST_FREE((*report)->reading);
    OST_FREE(*report);
}

int hard_passed(const HardReport *report)
{
    int failed = 0;
    for (int i = 0; i < report->count; i++)
        failed += report->reading[i].outcome == HARD_GIVEN_UP || report->reading[i].outcome == HARD_FALSE;
    return failed == 0;
}

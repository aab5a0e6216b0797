/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <stdio.h>
#include <string.h>

/* Largest relative imbalance of loads and reactions (forces and moments), and of strain energy and work, in any run. */
static const double balance = 1e-10;

/* Strain energy and work differ by u·r. Rounding alone leaves a relative difference of up to 2^-53 |u|·|K| |u| / f·u:
 * 2.4e-9 for the finest beam (10 × 1 × 1, 245,760 tets), where the stiffness of one tet is far above that of the beam.
 * Nearly all of it occurs, because equal tets have equal rounding errors. */
static const double energy_balance = 2.4e-9;

/* The observed order of convergence must be at least this share of the theoretical one. An implementation that loses an
 * order reaches three quarters at most. Quick runs stop before the order settles, so less is asked of them. */
static const double share_of_order = 0.9, quick_share_of_order = 0.6;

/* Errors below this are rounding errors, and have no rate of convergence. */
static const double rounding = 1e-10;

/* The estimated error of the answer over the true one, from the second mesh on; and what counts as rounding of both
 * where the elements hold the solution. */
static const double least_effectivity = 0.7, most_effectivity = 1.5;
static const double energy_rounding = 1e-8;

/* Where linear tets are expected to lock, the error must be at least this share of its limit. */
static const double locked_share = 0.5;

/* The estimated error of the answer over the true one, in the norm of the energy. */
static OstStatus measure_estimate(const OstScene *scene, const OstResult *result, const OstExact *exact,
                                  OstVerifyRun *run)
{
    const OstVerifyQuantity norm = {.name = "energy norm", .kind = OST_MEASURE_FIELD, .norm = OST_NORM_ENERGY};
    OstVerifyReading truth;
    OST_TRY(ost_verify_measure(scene, result, exact, &norm, &truth));
    run->energy_error = truth.error;
    run->estimate = result->answer.known ? result->answer.energy_norm / truth.expected : NAN;
    run->effectivity = truth.error >= energy_rounding ? run->estimate / truth.error : NAN;
    return OST_SUCCESS;
}

static OstStatus measure_all(const OstScene *scene, const OstResult *result, const OstExact *exact, OstVerifyRun *run)
{
    const OstVerify *verify = scene->c->verify;
    const OstMesh *mesh = scene->mesh;
    double volume = 0.0;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        volume += ost_tet_volume(mesh->coordinates, mesh->tet_nodes + (size_t)mesh->nodes_per_tet * (size_t)tet);
    OST_TRY(ost_sum(mesh->ctx, 1, &volume));
    run->tets = mesh->global_tets;
    run->unknowns = result->unknowns;
    run->h = cbrt(6.0 * volume / (double)run->tets);
    run->iterations = result->solve.iterations;
    run->checks = result->checks;
    OST_TRY(measure_estimate(scene, result, exact, run));
    for (int q = 0; q < verify->quantity_count; q++)
        OST_TRY(ost_verify_measure(scene, result, exact, &verify->quantity[q], &run->reading[q]));
    return OST_SUCCESS;
}

/* Warnings reach rank 0 alone. */
static void hear_locking(void *listener, const char *text)
{
    OstVerifyRun *run = listener;
    run->warned_of_locking |= strstr(text, "lock") != NULL;
}

static OstStatus solve_and_measure(const OstCase *c, const OstExact *exact, OstVerifyRun *run)
{
    OstScene *scene = NULL;
    OstResult *result = NULL;
    const double start = ost_seconds();
    ost_warn_listen(c->ctx, hear_locking, run);
    OstStatus status = ost_scene_create(c, &scene);
    ost_warn_listen(c->ctx, NULL, NULL);
    if (status != OST_SUCCESS)
        goto done;
    scene->exact = &exact->field;
    OST_TRY_DONE(ost_scene_solve(scene, &result));
    OST_TRY_DONE(measure_all(scene, result, exact, run));
    status = ost_broadcast(c->ctx, sizeof run->warned_of_locking, &run->warned_of_locking);
done:
    run->seconds = ost_seconds() - start;
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return status;
}

static OstStatus run_level(OstVerifyReport *report, const OstExact *exact, int step, int level)
{
    OstContext *ctx = report->ctx;
    OstCase *c = report->c;
    const OstVerifyStep *steps = &c->verify->step[step];
    OST_TRY(ost_agree(ctx, OST_RESIZE(ctx, &report->run, report->run_count + 1)));
    OstVerifyRun *run = &report->run[report->run_count++];
    run->step = step;
    run->refinement = steps->refinement[level];
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &run->reading, c->verify->quantity_count)));
    c->order = steps->order;
    c->refinement = run->refinement;
    c->output_fields = 1U << OST_FIELD_ERROR;
    c->asks_error = 0;
    return solve_and_measure(c, exact, run);
}

static OstStatus run_all_meshes(OstVerifyReport *report, const OstExact *exact, int quick)
{
    const OstVerify *verify = report->c->verify;
    char what[256];
    for (int s = 0; s < verify->step_count; s++) {
        const int levels = quick ? verify->step[s].quick_count : verify->step[s].level_count;
        for (int l = 0; l < levels; l++) {
            snprintf(what, sizeof what, "%.150s: order %d, refined %d times", report->name, verify->step[s].order,
                     verify->step[s].refinement[l]);
            ost_progress_task(report->ctx, what, l, levels);
            OST_TRY(run_level(report, exact, s, l));
        }
    }
    return OST_SUCCESS;
}

/* --- what the readings say --- */

/* Locking as expected: the program warned of it, the error falls with each refinement and from the stiff side, and (on
 * all meshes: `whole`) it ends within its limits. */
static int is_locked(const OstVerifyReport *report, int quantity, int step, const OstVerifyVerdict *verdict, int whole)
{
    const int is_field = report->c->verify->quantity[quantity].kind == OST_MEASURE_FIELD;
    double before = 1.0;
    int locked = 1;
    for (int r = 0; r < report->run_count; r++) {
        const OstVerifyReading *reading = &report->run[r].reading[quantity];
        if (report->run[r].step != step)
            continue;
        locked &= report->run[r].warned_of_locking && reading->error < before;
        locked &= is_field || fabs(reading->obtained) < fabs(reading->expected);
        before = reading->error;
    }
    return locked && (!whole || (before <= verdict->error_limit && before >= locked_share * verdict->error_limit));
}

static int holds_exactly(const OstVerifyReport *report, int quantity, int step, double limit)
{
    int holds = 1;
    for (int r = 0; r < report->run_count; r++)
        holds &= report->run[r].step != step || report->run[r].reading[quantity].error <= limit;
    return holds;
}

/* A quick run leaves out the finest meshes; its limit is scaled up by the theoretical order. */
static void judge(const OstVerifyReport *report, int quantity, int step, OstVerifyVerdict *verdict)
{
    const OstVerifyQuantity *stated = &report->c->verify->quantity[quantity];
    const double order = stated->rate[step];
    int last = -1, before = -1, count = 0;
    for (int r = 0; r < report->run_count; r++)
        if (report->run[r].step == step) {
            before = last;
            last = r;
            count++;
        }
    *verdict = (OstVerifyVerdict){last, NAN, stated->error[step], order, 1};
    if (last < 0)
        return;
    const double error = report->run[last].reading[quantity].error;
    const int missing = report->c->verify->step[step].level_count - count;
    if (before >= 0 && error >= rounding && !isnan(order))
        verdict->rate = log2(report->run[before].reading[quantity].error / error);
    if (order == OST_RATE_LOCKED) {
        verdict->passed = is_locked(report, quantity, step, verdict, missing == 0);
    } else if (isnan(order)) {
        verdict->passed = holds_exactly(report, quantity, step, verdict->error_limit);
    } else {
        verdict->error_limit *= pow(2.0, order * missing);
        const double share = missing == 0 ? share_of_order : quick_share_of_order;
        verdict->passed = error <= verdict->error_limit && (isnan(verdict->rate) || verdict->rate >= share * order);
    }
}

/* An answer without error is estimated to have none. */
static int is_estimated(const OstVerifyRun *run)
{
    if (isnan(run->effectivity))
        return run->estimate <= energy_rounding;
    return run->effectivity >= least_effectivity && run->effectivity <= most_effectivity;
}

/* From the second mesh of each order on. */
static void judge_estimates(OstVerifyReport *report)
{
    report->estimated = 1;
    report->effectivity[0] = report->effectivity[1] = NAN;
    for (int r = 1; r < report->run_count; r++) {
        const OstVerifyRun *run = &report->run[r];
        if (run->step != report->run[r - 1].step)
            continue;
        report->estimated &= is_estimated(run);
        report->effectivity[0] = fmin(report->effectivity[0], run->effectivity); /* of NAN and a number, the number */
        report->effectivity[1] = fmax(report->effectivity[1], run->effectivity);
    }
}

static OstStatus conclude(OstVerifyReport *report)
{
    const OstVerify *verify = report->c->verify;
    OST_TRY(OST_NEW(report->ctx, &report->verdict, verify->quantity_count * verify->step_count));
    for (int r = 0; r < report->run_count; r++) {
        const OstChecks *checks = &report->run[r].checks;
        report->force_imbalance = fmax(report->force_imbalance, checks->force_imbalance);
        report->moment_imbalance = fmax(report->moment_imbalance, checks->moment_imbalance);
        report->energy_imbalance = fmax(report->energy_imbalance, checks->energy_imbalance);
    }
    if (!report->failure)
        judge_estimates(report);
    report->passed = report->failure == NULL && report->estimated && report->force_imbalance <= balance &&
                     report->moment_imbalance <= balance && report->energy_imbalance <= energy_balance;
    for (int q = 0; q < verify->quantity_count && !report->failure; q++)
        for (int s = 0; s < verify->step_count; s++) {
            OstVerifyVerdict *verdict = &report->verdict[q * verify->step_count + s];
            judge(report, q, s, verdict);
            report->passed &= verdict->passed;
        }
    return OST_SUCCESS;
}

/* A run without an answer fails the case; any other failure ends the study. */
static OstStatus take_failure(OstVerifyReport *report, OstStatus status)
{
    if (status != OST_NOT_CONVERGED && status != OST_CHECK_FAILED)
        return status;
    return ost_agree(report->ctx, ost_copy_string(report->ctx, ost_error_text(report->ctx), &report->failure));
}

static OstStatus create_report(OstContext *ctx, const char *path, OstVerifyReport **report)
{
    const char *slash = strrchr(path, '/');
    OST_TRY(OST_NEW(ctx, report, 1));
    (*report)->ctx = ctx;
    OST_TRY(ost_copy_string(ctx, slash ? slash + 1 : path, &(*report)->name));
    char *dot = strrchr((*report)->name, '.');
    if (dot && dot != (*report)->name)
        *dot = 0;
    return OST_SUCCESS;
}

OstStatus ost_verify_case(OstContext *ctx, const char *path, int settings, const char *const *setting, int quick,
                          OstVerifyReport **out)
{
    OstVerifyReport *report = NULL;
    OstExact exact;
    const double start = ost_seconds();
    *out = NULL;
    OstStatus status = ost_agree(ctx, create_report(ctx, path, &report));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_case_read_with(ctx, path, settings, setting, &report->c));
    OST_TRY_DONE(ost_agree(ctx, ost_exact_create(report->c, &exact)));
    OST_TRY_DONE(take_failure(report, run_all_meshes(report, &exact, quick)));
    OST_TRY_DONE(ost_agree(ctx, conclude(report)));
    report->seconds = ost_seconds() - start;
done:
    ost_progress_task(ctx, "", 0, 0);
    if (status != OST_SUCCESS)
        ost_verify_report_destroy(&report);
    *out = report;
    return status;
}

void ost_verify_report_destroy(OstVerifyReport **report)
{
    if (!*report)
        return;
    for (int r = 0; r < (*report)->run_count; r++)
        OST_FREE((*report)->run[r].reading);
    OST_FREE((*report)->run, (*report)->verdict, (*report)->name, (*report)->failure);
    ost_case_destroy(&(*report)->c);
    OST_FREE(*report);
}

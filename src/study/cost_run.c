/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "adapt/adapt.h"
#include "core/error.h"
#include "core/parallel/gather.h"

#include <math.h>
#include <stdio.h>

/* A refinement has 8 times the tets. The work of multigrid grows as much, that of a factorisation faster: the growth
 * that was measured counts, within these bounds. */
static const double least_growth = 8.0, most_growth = 32.0;

/* Order 2 has the nodes of order 1 on the refined mesh, and about three times as many entries per row. */
static const double denser_rows = 3.0;

/* The finished run to predict another from: of its own order rather than the one below, on the finest mesh, of the same
 * tolerance; else the slowest. */
static const OstCostRun *find_model(const OstCost *cost, const OstCostRun *run)
{
    const OstCostRun *best = NULL;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *other = &cost->run[i];
        if (other->state != OST_COST_DONE || !ost_cost_is_plain(other) || other->order > run->order)
            continue;
        if (!best || other->order > best->order ||
            (other->order == best->order && other->refinement > best->refinement)) {
            best = other;
            continue;
        }
        if (other->order != best->order || other->refinement != best->refinement || best->tolerance == run->tolerance)
            continue;
        if (other->tolerance == run->tolerance || other->seconds > best->seconds)
            best = other;
    }
    return best;
}

/* The factor by which the seconds grew from the previous refinement to the model. */
static double growth_to(const OstCost *cost, const OstCostRun *model)
{
    double growth = least_growth;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *other = &cost->run[i];
        if (other->state == OST_COST_DONE && ost_cost_is_plain(other) && other->order == model->order &&
            other->tolerance == model->tolerance && other->refinement + 1 == model->refinement && other->seconds > 0.0)
            growth = model->seconds / other->seconds;
    }
    return fmin(fmax(growth, least_growth), most_growth);
}

/* Seconds and bytes of a run; 0: not known. */
static void predict(const OstCost *cost, const OstCostRun *run, double *seconds, double *bytes)
{
    const OstCostRun *model = run->accuracy == 0.0 ? find_model(cost, run) : NULL; /* an adaptive run limits itself */
    *seconds = *bytes = 0.0;
    if (!model)
        return;
    const int steps = run->refinement - model->refinement + run->order - model->order;
    const double denser = run->order > model->order ? denser_rows : 1.0;
    *seconds = model->seconds * pow(growth_to(cost, model), steps) * denser;
    *bytes = model->bytes * pow(least_growth, steps) * denser;
}

static void describe_seconds(double seconds, char *text, size_t size)
{
    if (seconds < 9.5)
        snprintf(text, size, "about %.1g s", seconds);
    else if (seconds < 120.0)
        snprintf(text, size, "about %.0f s", seconds);
    else if (seconds < 7200.0)
        snprintf(text, size, "about %.0f min", seconds / 60.0);
    else
        snprintf(text, size, "about %.0f h", seconds / 3600.0);
}

/* Requests come last: half of the time is theirs, in equal parts of what is left. */
static double seconds_until(const OstCost *cost, const OstCostRun *run, double elapsed)
{
    const double most = cost->variants.max_seconds;
    int requests = 0;
    for (int i = 0; i < cost->run_count; i++)
        requests += cost->run[i].accuracy != 0.0 && cost->run[i].state == OST_COST_WAITING;
    if (run->accuracy != 0.0)
        return elapsed + (most - elapsed) / fmax(requests, 1.0);
    return requests > 0 ? 0.5 * most : most;
}

/* Collective. Clocks differ between ranks; rank 0's decides. */
static OstStatus fits(OstCost *cost, OstCostRun *run, double start, int *yes)
{
    const OstCostVariants *variants = &cost->variants;
    double bytes, elapsed = ost_seconds() - start;
    predict(cost, run, &run->predicted_seconds, &bytes);
    bytes *= ost_memory_beside;
    OST_TRY(ost_broadcast(cost->ctx, sizeof elapsed, &elapsed));
    const double until = seconds_until(cost, run, elapsed);
    const int is_late = run->accuracy != 0.0 && elapsed >= variants->max_seconds;
    const int too_slow = run->predicted_seconds != 0.0 && elapsed + run->predicted_seconds > until;
    const int too_large = variants->max_bytes > 0.0 && bytes > variants->max_bytes;
    if (too_slow)
        describe_seconds(run->predicted_seconds, run->reason, sizeof run->reason);
    else if (too_large)
        snprintf(run->reason, sizeof run->reason, "about %.2g GiB of memory, of %.2g there are", bytes / 0x1p30,
                 variants->max_bytes / 0x1p30);
    else if (is_late)
        snprintf(run->reason, sizeof run->reason, "no time is left");
    run->seconds_left = until - elapsed;
    *yes = !too_slow && !too_large && !is_late;
    return OST_SUCCESS;
}

static void announce(const OstCost *cost, const OstCostRun *run, int number)
{
    char line[200], about[32] = "", more[64];
    ost_cost_describe(run, more, sizeof more);
    if (run->predicted_seconds > 0.0)
        describe_seconds(run->predicted_seconds, about, sizeof about);
    if (run->accuracy != 0.0)
        snprintf(line, sizeof line, "run %d of %d: adaptively to %g", number + 1, cost->run_count, run->accuracy);
    else
        snprintf(line, sizeof line, "run %d of %d: order %d, refinement %d, tolerance %g%s%s%s%s", number + 1,
                 cost->run_count, run->order, run->refinement, run->tolerance, more[0] ? ", " : "", more,
                 about[0] ? ", " : "", about);
    ost_log(cost->ctx, OST_LOG_VERBOSE, "%s", line);
    ost_progress_task(cost->ctx, line, number, cost->run_count);
}

/* A tolerance is kept to the end; an adaptive run chooses its own. */
static void vary(const OstCostRun *run, OstCase *variant)
{
    variant->output_fields = 1U << OST_FIELD_ERROR;
    if (run->accuracy != 0.0) {
        variant->asks_error = 1;
        variant->relative_error = run->accuracy;
        variant->solver.algebraic_fraction = ost_case_stop_fraction(variant);
        return;
    }
    variant->asks_error = 0;
    variant->order = run->order;
    variant->refinement = run->refinement;
    variant->solver.relative_residual = run->tolerance;
    variant->solver.algebraic_fraction = 0.0;
    if (run->load_steps > 0)
        variant->solver.load_steps = run->load_steps;
    if (run->other && run->formulation == OST_FORMULATION_LINEAR)
        variant->large_rotation = OST_LARGE_ROTATION_OFF;
    else if (run->other)
        variant->formulation = run->formulation;
}

/* Drops runs of large rotations that wait where no run has found any. */
static void drop_large_rotations(OstCost *cost)
{
    int kept = 0, any = 0;
    for (int i = 0; i < cost->run_count; i++)
        any |= cost->run[i].newton.used;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (any || run->state != OST_COST_WAITING || ost_cost_is_plain(run) || run->accuracy != 0.0)
            cost->run[kept++] = *run;
    }
    cost->run_count = kept;
}

OstStatus ost_cost_run(OstCost *cost)
{
    OstContext *ctx = cost->ctx;
    const double start = ost_seconds();
    OstStatus last_failure = OST_SUCCESS;
    int done = 0;
    for (int i = 0; i < cost->run_count; i++) {
        if (!ost_cost_is_plain(&cost->run[i]))
            drop_large_rotations(cost);
        if (i == cost->run_count)
            break;
        OstCostRun *run = &cost->run[i];
        int affordable = 0;
        OST_TRY(fits(cost, run, start, &affordable));
        if (!affordable) {
            run->state = OST_COST_NOT_RUN;
            continue;
        }
        announce(cost, run, i);
        OstCase variant = *cost->c;
        vary(run, &variant);
        const OstStatus status = cost->measure(cost, &variant, run);
        run->state = status == OST_SUCCESS ? OST_COST_DONE : OST_COST_FAILED;
        done += status == OST_SUCCESS;
        if (status != OST_SUCCESS) {
            last_failure = status;
            snprintf(run->reason, sizeof run->reason, "%s", ost_error_text(ctx));
        }
    }
    ost_progress_task(ctx, "", 0, 0);
    cost->seconds = ost_seconds() - start;
    ost_cost_judge(cost);
    return done > 0 ? OST_SUCCESS : last_failure;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "adapt/adapt.h"
#include "case/select.h"
#include "core/error.h"

#include <math.h>
#include <stdio.h>

/* Other work on the machine disturbs short runs most: they are repeated, and the fastest counts. */
enum { MOST_REPEATS = 3 };
static const double long_enough = 0.5;

static void note(const OstMeter *meter, OstCostRun *run)
{
    run->seconds = meter->seconds;
    run->bytes = meter->bytes;
    ost_stage_sum(meter, run->phase);
}

/* In the norm of the energy, as the run tells it: of the mesh, and of equations that are solved to the tolerance. */
static double estimate_of(const OstResult *result)
{
    const OstAnswerError *answer = &result->answer;
    const double of_equations = result->solve.algebraic_error;
    if (!answer->known)
        return NAN;
    return answer->energy_norm > 0.0 && isfinite(of_equations)
               ? answer->relative * hypot(1.0, of_equations / answer->energy_norm)
               : answer->relative;
}

static OstStatus evaluate(OstCost *cost, const OstScene *scene, const OstResult *result, OstCostRun *run)
{
    run->unknowns = result->unknowns;
    run->tets = scene->mesh->global_tets;
    run->iterations = result->solve.iterations;
    run->residual = result->solve.relative_residual;
    run->newton = result->newton;
    run->order = scene->mesh->nodes_per_tet == 10 ? 2 : 1;
    run->estimate = estimate_of(result);
    const double displacement_error =
        result->answer.known ? result->answer.displacement * result->largest_displacement : NAN;
    for (int w = 0; w < cost->c->watch_count && !cost->placed; w++)
        OST_TRY(ost_watch_place(scene->mesh, &cost->watch[w]));
    cost->placed = 1;
    for (int q = 0; q < cost->quantity_count; q++) {
        const OstWatch *watch = cost->quantity[q].watch;
        if (watch)
            OST_TRY(ost_watch_evaluate(scene, result, watch, &run->watched[q]));
        else
            run->watched[q] = (OstWatched){.value = result->largest_displacement,
                                           .scale = result->largest_displacement,
                                           .error = displacement_error};
    }
    return OST_SUCCESS;
}

static OstStatus measure_once(OstCost *cost, const OstCase *variant, OstCostRun *run)
{
    const OstLogLevel level = ost_log_level(cost->ctx);
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstMeter meter;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_meter_start(cost->ctx, &meter));
    if (cost->heard[variant->order - 1] && level == OST_LOG_NORMAL) /* warnings of the first run of an order suffice */
        ost_log_set_level(cost->ctx, OST_LOG_QUIET);
    OST_TRY_DONE(ost_scene_create(variant, &scene));
    OST_TRY_DONE(ost_scene_solve(scene, &result));
    OST_TRY_DONE(ost_meter_read(cost->ctx, &meter));
    note(&meter, run);
    ost_log_set_level(cost->ctx, level);
    status = evaluate(cost, scene, result, run);
    cost->heard[variant->order - 1] = 1;
done:
    ost_log_set_level(cost->ctx, level);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return status;
}

/* Until the accuracy is met, or time or memory run out. */
static OstStatus measure_adaptive(OstCost *cost, const OstCase *variant, OstCostRun *run)
{
    OstContext *ctx = cost->ctx;
    const OstLogLevel level = ost_log_level(ctx);
    const OstAdaptLimits limits = {.seconds = run->seconds_left,
                                   .bytes = cost->variants.max_bytes > 0.0 ? cost->variants.max_bytes : INFINITY};
    OstAdaption *adaption = NULL;
    OstMeter meter;
    OstStatus status = ost_meter_start(ctx, &meter);
    if (level == OST_LOG_NORMAL) /* every mesh on the way would warn */
        ost_log_set_level(ctx, OST_LOG_QUIET);
    OST_THEN(ost_adapt(variant, &limits, &adaption));
    OST_THEN(ost_meter_read(ctx, &meter));
    if (status == OST_SUCCESS) {
        note(&meter, run);
        status = evaluate(cost, ost_adaption_scene(adaption), ost_adaption_result(adaption), run);
        run->levels = adaption->count;
        if (adaption->end != OST_ADAPT_MET) {
            char words[OST_LONGEST_ADAPT_WORDS];
            ost_adaption_words(adaption, words);
            snprintf(run->reason, sizeof run->reason, "%s", words);
        }
    }
    ost_log_set_level(ctx, level);
    ost_adaption_destroy(&adaption);
    return status;
}

OstStatus ost_cost_measure(OstCost *cost, const OstCase *variant, OstCostRun *run)
{
    double spent = 0.0;
    do {
        OstCostRun again = *run;
        OST_TRY(run->accuracy != 0.0 ? measure_adaptive(cost, variant, &again) : measure_once(cost, variant, &again));
        again.repeats = run->repeats + 1;
        spent += again.seconds;
        if (run->repeats == 0 || again.seconds < run->seconds)
            *run = again;
        run->repeats = again.repeats;
    } while (run->repeats < MOST_REPEATS && spent < long_enough);
    return OST_SUCCESS;
}

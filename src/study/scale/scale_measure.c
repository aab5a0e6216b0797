/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/scale/scale.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "orthostat/scene.h"
#include "problem/result_data.h"
#include "problem/scene_data.h"

#include <math.h>
#include <stdio.h>

/* Other work on the machine disturbs short runs most: they are repeated, and the fastest counts. */
enum { MOST_REPEATS = 3 };
static const double long_enough = 0.5;

/* Mean and most over the ranks of `count` numbers. */
static OstStatus count_ranks(OstContext *ctx, int count, const double *mine, OstScaleCount *counts)
{
    double sum[64], most[64];
    for (int i = 0; i < count; i++)
        sum[i] = most[i] = mine[i];
    OST_TRY(ost_sum(ctx, count, sum));
    OST_TRY(ost_max(ctx, count, most));
    for (int i = 0; i < count; i++)
        counts[i] = (OstScaleCount){sum[i] / ost_size(ctx), most[i]};
    return OST_SUCCESS;
}

/* What `work` is per time, over the ranks; exchanges and the like are as on the rank with the most. */
static OstStatus share_work(OstContext *ctx, const OstWork *work, double times, OstScaleWork *shared)
{
    const double one = times > 0.0 ? 1.0 / times : 0.0;
    const double mine[] = {one * work->messages,   one * work->bytes,     one * work->gathered,
                           one * work->multiplied, one * work->exchanges, one * work->reductions,
                           one * work->gathers,    one * work->visits,    work->multiplied > 0.0};
    OstScaleCount counts[9];
    OST_TRY(count_ranks(ctx, 9, mine, counts));
    shared->messages = counts[0];
    shared->bytes = counts[1];
    shared->gathered = counts[2];
    shared->multiplied = counts[3];
    shared->exchanges = counts[4].most;
    shared->reductions = counts[5].most;
    shared->gathers = counts[6].most;
    shared->visits = counts[7].most;
    shared->ranks = round(counts[8].mean * ost_size(ctx));
    return OST_SUCCESS;
}

static OstWork less(OstWork a, const OstWork *b)
{
    a.multiplied -= b->multiplied;
    a.exchanges -= b->exchanges;
    a.messages -= b->messages;
    a.bytes -= b->bytes;
    a.reductions -= b->reductions;
    a.gathers -= b->gathers;
    a.gathered -= b->gathered;
    a.visits -= b->visits;
    return a;
}

/* All by cycles of multigrid, of which an iteration has one: corrections of rounding iterate outside of the solve. */
static OstStatus count_work(OstContext *ctx, const OstSolveReport *solve, OstScaleRun *run)
{
    OstWork outside = ost_ledger_entry(ctx, OST_LEDGER_SOLVE).work;
    const OstWork setup = ost_ledger_entry(ctx, OST_LEDGER_HIERARCHY).work;
    run->levels = solve->levels < OST_SCALE_LEVELS ? solve->levels : OST_SCALE_LEVELS;
    run->cycles = (int)ost_ledger_level_work(ctx, 0).visits;
    for (int l = 0; l < run->levels; l++) {
        const OstWork level = ost_ledger_level_work(ctx, l);
        outside = less(outside, &level);
        OST_TRY(share_work(ctx, &level, run->cycles, &run->level[l]));
        run->level[l].unknowns = (double)solve->level_unknowns[l];
    }
    OST_TRY(share_work(ctx, &outside, run->cycles > 0 ? run->cycles : run->iterations, &run->iteration));
    run->iteration.visits = 1.0;
    run->iteration.unknowns = (double)run->unknowns;
    return share_work(ctx, &setup, 1.0, &run->setup);
}

static OstStatus evaluate(const OstScene *scene, const OstResult *result, const OstMeter *meter, double bytes,
                          OstScaleRun *run)
{
    OstContext *ctx = result->ctx;
    const OstWork solve = ost_ledger_entry(ctx, OST_LEDGER_SOLVE).work;
    const double mine[] = {bytes, scene->mesh->owned_nodes, scene->mesh->tet_count, solve.multiplied};
    OstScaleCount counts[4];
    run->unknowns = result->unknowns;
    run->tets = scene->mesh->global_tets;
    run->iterations = result->solve.iterations;
    run->residual = result->solve.relative_residual;
    run->seconds = meter->seconds;
    run->bytes = meter->bytes;
    snprintf(run->engine, sizeof run->engine, "%s", result->solve.engine);
    ost_stage_sum(meter, run->stage);
    OST_TRY(count_ranks(ctx, 4, mine, counts));
    run->memory = counts[0];
    run->nodes = counts[1];
    run->tets_of_rank = counts[2];
    run->work = counts[3];
    return count_work(ctx, &result->solve, run);
}

static OstStatus measure_once(OstCase *c, OstScaleRun *run)
{
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstMeter meter;
    OstStatus status;
    OST_TRY_DONE(ost_meter_start(c->ctx, &meter));
    const double before = (double)ost_ledger_bytes(c->ctx);
    OST_TRY_DONE(ost_scene_create(c, &scene));
    OST_TRY_DONE(ost_scene_solve(scene, &result));
    OST_TRY_DONE(ost_meter_read(c->ctx, &meter));
    status = evaluate(scene, result, &meter, (double)ost_ledger_peak_bytes(c->ctx) - before, run);
done:
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return status;
}

OstStatus ost_scale_measure(OstCase *c, OstScaleRun *run)
{
    OST_TRY(measure_once(c, run));
    run->repeats = 1;
    for (double spent = run->seconds; run->repeats < MOST_REPEATS && spent < long_enough && !run->crowded;) {
        OstScaleRun again = *run;
        ost_ledger_forget_work(c->ctx);
        OST_TRY(measure_once(c, &again));
        spent += again.seconds;
        if (again.seconds < run->seconds) {
            again.repeats = run->repeats;
            *run = again;
        }
        run->repeats++;
    }
    return OST_SUCCESS;
}

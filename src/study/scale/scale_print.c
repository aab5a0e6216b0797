/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/scale/model.h"
#include "study/scale/scale.h"

#include <stdio.h>

static const double kilobyte = 1e3, mebibyte = 1048576.0;

static void print_seconds(double seconds)
{
    if (seconds < 0.9995)
        printf(" %7.1f ms", 1e3 * seconds);
    else
        printf(seconds < 99.95 ? " %8.2f s" : " %8.0f s", seconds);
}

static double efficiency(const OstScaleRun *run, const OstScaleRun *reference, int weak)
{
    const double work = weak ? 1.0 : (double)reference->ranks / run->ranks;
    return work * reference->seconds / run->seconds;
}

static void print_run(const OstScale *scale, const OstScaleRun *run, int weak)
{
    const OstScaleRun *reference = ost_scale_reference(scale, run, weak);
    printf("  %6d", run->ranks);
    if (run->state != OST_SCALE_DONE) {
        printf("   %s: %s\n", ost_scale_state_word[run->state], run->reason);
        return;
    }
    printf(" %12lld %6d %8.2f", (long long)run->unknowns, run->iterations,
           run->bytes / kilobyte / (double)run->unknowns);
    for (int s = OST_STAGE_MESH; s <= OST_STAGE_SOLVE && !run->crowded; s++)
        print_seconds(run->stage[s]);
    if (!run->crowded)
        print_seconds(run->seconds);
    else
        printf(" %50s", "more ranks than cores");
    if (reference && !run->crowded)
        printf(" %9.2f", efficiency(run, reference, weak));
    else
        printf(" %9s", "-");
    printf(" %8.2f\n", run->work.most > 0.0 ? run->work.mean / run->work.most : 1.0);
}

static void print_runs(const OstScale *scale, int weak)
{
    int listed = 0;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *run = &scale->run[i];
        if (weak ? !run->is_weak : !run->is_strong)
            continue;
        if (!listed++)
            printf("\n%s\n  %6s %12s %6s %8s %10s %10s %10s %10s %10s %9s %8s\n",
                   weak ? "weak scaling: the size grows with the ranks" : "strong scaling: a size on more ranks",
                   "ranks", "unknowns", "iter.", "kB/unkn.", ost_stage_label[OST_STAGE_MESH],
                   ost_stage_label[OST_STAGE_ASSEMBLY], ost_stage_label[OST_STAGE_SETUP],
                   ost_stage_label[OST_STAGE_SOLVE], "total", "efficiency", "balance");
        print_run(scale, run, weak);
    }
}

static void print_work(const char *name, const OstScaleWork *work)
{
    printf("  %-12s %12.0f %6.0f %7.1f %10.1f %10.1f %10.1f %10.1f %8.1f %8.1f %10.1f\n", name, work->unknowns,
           work->ranks, work->visits, work->exchanges, work->messages.mean, work->messages.most,
           work->bytes.most / kilobyte, work->reductions, work->gathers, work->multiplied.most / 1e3);
}

static void print_counts(const OstScale *scale)
{
    const OstScaleRun *run = ost_scale_base(scale);
    char name[32];
    if (!run)
        return;
    printf("\nwhat a rank does in an iteration: %lld unknowns on %d rank%s, %s\n"
           "  %-12s %12s %6s %7s %10s %10s %10s %10s %8s %8s %10s\n",
           (long long)run->unknowns, run->ranks, run->ranks == 1 ? "" : "s", run->engine, "", "unknowns", "ranks",
           "visits", "exchanges", "messages", "at most", "kB, most", "sums", "gathers", "10³ entries");
    print_work("stiffness", &run->iteration);
    for (int l = 0; l < run->levels; l++) {
        snprintf(name, sizeof name, "level %d", l);
        print_work(name, &run->level[l]);
    }
}

static void print_forecast(const OstScaleForecast *f)
{
    printf("  %8.0f %12.3g %6d %10.3g", f->ranks, f->unknowns, f->levels, f->coarsest);
    print_seconds(f->seconds);
    for (int p = 0; p < OST_SCALE_PARTS; p++)
        printf(" %13.1f %%", 100.0 * f->part[p] / f->seconds);
    printf("\n");
}

static void print_forecasts(const OstScale *scale, const OstScaleRun *run, int weak)
{
    const OstNetwork *network = &scale->variants.network;
    OstScaleForecast forecast[OST_SCALE_FORECASTS];
    char words[512];
    const double base = (double)run->unknowns;
    printf("\n%s, on %s (%.3g s a message, %.3g GB/s out of a node, %.3g GB/s of memory, %.0f ranks a node)\n"
           "  %8s %12s %6s %10s %10s",
           weak ? "foretold, weak" : "foretold, strong", network->name, network->latency, network->bandwidth / 1e9,
           network->memory / 1e9, network->ranks, "ranks", "unknowns", "levels", "coarsest", "iteration");
    for (int p = 0; p < OST_SCALE_PARTS; p++)
        printf(" %15s", ost_scale_part_label[p]);
    printf("\n");
    for (int f = 0; f < OST_SCALE_FORECASTS; f++) {
        const double ranks = ost_scale_foretold[f];
        ost_scale_foretell(run, network, ranks, weak ? base / run->ranks * ranks : base, &forecast[f]);
        print_forecast(&forecast[f]);
    }
    ost_scale_first_limit(forecast, OST_SCALE_FORECASTS, words, sizeof words);
    printf("  stops it first: %s\n", words);
    const OstScaleForecast *last = &forecast[OST_SCALE_FORECASTS - 1];
    printf("  setup on %.0f ranks: METIS on rank 0 takes about %.2g s, lists of all ranks %.2g s\n", last->ranks,
           last->partition, last->lists);
}

/* Each run as the model foretells it from the run of the same size on fewer ranks. */
static void print_check(const OstScale *scale)
{
    int listed = 0;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *run = &scale->run[i], *from = NULL;
        OstScaleForecast forecast;
        if (!ost_scale_check(scale, run, &from, &forecast))
            continue;
        const double taken = run->stage[OST_STAGE_SOLVE] / run->cycles;
        if (!listed++)
            printf(
                "\nthe model beside what was measured here (%.2g s a message, %.2g GB/s of messages and %.2g GB/s of "
                "memory a rank)\n  %6s %12s %6s %24s %24s %24s\n",
                scale->here.latency, scale->here.bandwidth / scale->here.ranks / 1e9,
                scale->here.memory / scale->here.ranks / 1e9, "ranks", "unknowns", "from", "messages", "kB",
                "s an iteration");
        OstScaleCount messages, bytes;
        ost_scale_sent(run, &messages, &bytes);
        printf("  %6d %12lld %6d %10.1f, %6.1f (%.2f) %10.1f, %6.1f (%.2f)", run->ranks, (long long)run->unknowns,
               from->ranks, forecast.messages, messages.most, forecast.messages / messages.most,
               forecast.bytes / kilobyte, bytes.most / kilobyte, forecast.bytes / bytes.most);
        if (run->crowded || scale->here.memory == 0.0)
            printf(" %24s\n", "-");
        else
            printf(" %9.2g, %7.2g (%.2f)\n", forecast.seconds, taken, forecast.seconds / taken);
    }
}

static void print_crowded(const OstScale *scale)
{
    int crowded = 0;
    for (int i = 0; i < scale->run_count; i++)
        crowded += scale->run[i].state == OST_SCALE_DONE && scale->run[i].crowded;
    if (crowded > 0)
        printf("\n%d run%s had more ranks than the %d core%s here: only counts are shown of them, no seconds\n",
               crowded, crowded == 1 ? "" : "s", scale->cores, scale->cores == 1 ? "" : "s");
}

void ost_scale_print(const OstScale *scale)
{
    const OstScaleRun *base = ost_scale_base(scale);
    int done = 0;
    if (ost_rank(scale->ctx) != 0)
        return;
    for (int i = 0; i < scale->run_count; i++)
        done += scale->run[i].state == OST_SCALE_DONE;
    printf("%s: %s\n  %d of %d runs done in %.3g s, on up to %d ranks; seconds of the slowest rank, memory of our own "
           "arrays (%.1f MiB at most)\n",
           scale->path, scale->title, done, scale->run_count, scale->seconds, ost_size(scale->ctx),
           ost_scale_most_bytes(scale) / mebibyte);
    print_runs(scale, 0);
    print_runs(scale, 1);
    print_crowded(scale);
    print_counts(scale);
    if (!base) {
        printf("\nno run used multigrid: nothing is foretold (solver: {method: metric} asks for it)\n");
        return;
    }
    print_check(scale);
    print_forecasts(scale, base, 0);
    print_forecasts(scale, base, 1);
}

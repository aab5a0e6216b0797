/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/scale/model.h"

#include "algebra/multigrid/gathered_level.h"

#include <math.h>
#include <stdio.h>

#define PART_LABEL(name, label) [name] = label,
const char *const ost_scale_part_label[] = {OST_SCALE_PART_TABLE(PART_LABEL)};
#undef PART_LABEL

const double ost_scale_foretold[OST_SCALE_FORECASTS] = {1e3, 3e3, 1e4, 3e4, 1e5};

/* Bytes of an entry of a matrix: most are single precision, with their share of indices and vectors. */
static const double entry_bytes = 5.0;

/* Neighbours of a part inside of a body; unknowns of a node on the finest level and on the others. */
static const double inner_neighbours = 20.0, fine_width = 3.0, coarse_width = 6.0;

/* By how much a level is smaller than the one above, where no run has told; the last level has about so many unknowns,
 * or fewer; and what is factored, by LAPACK on every rank, or by MUMPS. */
static const double usual_gain = 8.0, coarsest_unknowns = 1000.0, dense_unknowns = 2000.0, factored_unknowns = 50000.0;
static const double least_gain = 1.25, coarsest_sweeps = 10.0;

/* The partition: clusters of a rank, and seconds that METIS takes for one of them. */
static const double clusters_of_rank = 64.0, cluster_seconds = 4e-6;

/* A level as it is foretold. */
typedef struct Level {
    double unknowns, width, ranks; /* ranks: that have a part of it */
    double visits;
} Level;

/* The share of a part's faces that are inside of the body. */
static double inside(double ranks)
{
    return 1.0 - 1.0 / cbrt(ranks);
}

/* Ghost nodes of a cube of nodes. */
static double ghosts_of(double nodes, double ranks)
{
    const double wider = cbrt(nodes) + 2.0;
    return (wider * wider * wider - nodes) * inside(ranks);
}

/* Where parts have few nodes, a node's neighbours belong to as many ranks: those within one and a half nodes. */
static double neighbours_of(double nodes, double ranks)
{
    const double wider = cbrt(nodes) + 3.0;
    return fmin(ranks - 1.0, inside(ranks) * fmax(inner_neighbours, wider * wider * wider / nodes - 1.0));
}

static double log2_of(double ranks)
{
    return ranks > 1.0 ? ceil(log2(ranks)) : 0.0;
}

/* The levels of so many unknowns, coarsened as those of the run and gathered on fewer ranks as multigrid does it;
 * returns how many. */
static int list_levels(const OstScaleRun *run, double ranks, double unknowns, Level *level)
{
    int count = 1, stride = 1;
    level[0] = (Level){.unknowns = unknowns, .width = fine_width, .ranks = fmin(ranks, unknowns / fine_width)};
    for (; count < OST_MAX_LEVELS && level[count - 1].unknowns > coarsest_unknowns; count++) {
        const Level *above = &level[count - 1];
        const int known = count + 1 < run->levels || (count + 1 == run->levels && count == 1);
        const double gain = known ? run->level[count - 1].unknowns / run->level[count].unknowns : usual_gain;
        const double next = fmax(above->unknowns / gain, coarse_width * above->ranks); /* one aggregate a rank */
        if (above->unknowns < least_gain * next)
            break;
        stride = ost_gathered_stride((OstGlobal)(next / coarse_width), (int)ranks, stride, next <= coarsest_unknowns);
        level[count] = (Level){.unknowns = next, .width = coarse_width, .ranks = ceil(ranks / stride)};
    }
    for (int l = 0; l < count; l++)
        level[l].visits = exp2(fmin(l, count > 1 ? count - 2 : 0));
    return count;
}

/* The level of the run whose counts stand for level l: not its last one, which is solved. */
static int model_level(const OstScaleRun *run, int l)
{
    const int deepest = run->levels > 1 ? run->levels - 2 : 0;
    return l < deepest ? l : deepest;
}

/* What a level costs where it is smoothed. */
static void add_level(const OstScaleRun *run, const OstNetwork *network, const Level *level, int l,
                      OstScaleForecast *forecast)
{
    const int m = model_level(run, l);
    const OstScaleWork *work = &run->level[m];
    const double visits = fmax(work->visits, 1.0), width = m == 0 ? fine_width : coarse_width;
    const double exchanges = level->visits * work->exchanges / visits;
    const double nodes = level->unknowns / (level->width * level->ranks);
    const double ghosts = ghosts_of(work->unknowns / (width * work->ranks), work->ranks);
    const double counted = work->exchanges > 0.0 ? work->bytes.most / (work->exchanges * 8.0 * width) : 0.0;
    /* The shape of this body's parts is other than a cube's. */
    const double shape = ghosts > 0.0 && counted > 0.0 ? counted / ghosts : 1.0;
    const double sent = 8.0 * level->width * shape * ghosts_of(nodes, level->ranks);
    const double entries = work->multiplied.mean * run->ranks / work->unknowns / visits; /* of an unknown */
    const double read = entry_bytes * level->visits * entries * level->unknowns / level->ranks;
    const double messages = exchanges * neighbours_of(nodes, level->ranks);
    forecast->part[OST_SCALE_MEMORY] += read * network->ranks / network->memory;
    forecast->part[OST_SCALE_MESSAGES] += messages * network->latency;
    forecast->part[OST_SCALE_BYTES] += exchanges * sent * network->ranks / network->bandwidth;
    forecast->messages += messages;
    forecast->bytes += exchanges * sent;
}

/* The last level: factored by LAPACK on one rank, or on every one that has some of it; by MUMPS through rank 0; or
 * smoothed if it is too large. */
static void add_coarsest(const OstScaleRun *run, const OstNetwork *network, const Level *level, int l,
                         OstScaleForecast *forecast)
{
    const double n = level->unknowns, visits = level->visits, bandwidth = network->bandwidth / network->ranks;
    double *seconds = &forecast->part[OST_SCALE_COARSEST];
    if (n > factored_unknowns) {
        OstScaleForecast swept = {0};
        const Level often = {n, level->width, level->ranks, coarsest_sweeps * visits};
        add_level(run, network, &often, l, &swept);
        for (int p = 0; p < OST_SCALE_PARTS; p++)
            *seconds += swept.part[p];
    } else if (n > dense_unknowns) { /* MPI_Gatherv and MPI_Scatterv: rank 0 hears from every rank */
        *seconds += 2.0 * visits * (level->ranks * network->latency + 8.0 * n / bandwidth);
    } else {
        const double read = 8.0 * n * n; /* of the factor, twice its half */
        *seconds += visits * read * network->ranks / network->memory;
        if (level->ranks > 1.0)
            *seconds += visits * (log2_of(level->ranks) * network->latency + 8.0 * n / bandwidth);
    }
}

void ost_scale_foretell(const OstScaleRun *run, const OstNetwork *network, double ranks, double unknowns,
                        OstScaleForecast *forecast)
{
    Level level[OST_MAX_LEVELS];
    *forecast = (OstScaleForecast){.ranks = ranks, .unknowns = unknowns};
    forecast->levels = list_levels(run, ranks, unknowns, level);
    forecast->coarsest = level[forecast->levels - 1].unknowns;
    const OstScaleWork *outside = &run->iteration;
    const Level whole = {.unknowns = unknowns, .width = fine_width, .ranks = ranks, .visits = 1.0};
    OstScaleForecast products = {0};
    OstScaleRun stiffness = *run;
    stiffness.level[0] = *outside;
    stiffness.levels = 1;
    add_level(&stiffness, network, &whole, 0, &products);
    double most = 0.0;
    for (int l = 0; l < forecast->levels; l++) {
        const double before = forecast->part[OST_SCALE_MESSAGES];
        if (l + 1 < forecast->levels || l == 0)
            add_level(run, network, &level[l], l, forecast);
        else
            add_coarsest(run, network, &level[l], l, forecast);
        const double here = forecast->part[OST_SCALE_MESSAGES] - before;
        if (here > most) {
            most = here;
            forecast->slowest_level = l;
        }
    }
    forecast->part[OST_SCALE_SUMS] = outside->reductions * log2_of(ranks) * network->latency;
    for (int p = 0; p < OST_SCALE_PARTS; p++) {
        forecast->part[p] += products.part[p];
        forecast->seconds += forecast->part[p];
    }
    forecast->messages += products.messages;
    forecast->bytes += products.bytes;
    forecast->efficiency = forecast->part[OST_SCALE_MEMORY] / forecast->seconds;
    forecast->partition = clusters_of_rank * ranks * cluster_seconds;
    forecast->lists =
        run->setup.gathers * (log2_of(ranks) * network->latency + 8.0 * ranks * network->ranks / network->bandwidth);
}

const OstScaleRun *ost_scale_base(const OstScale *scale)
{
    const OstScaleRun *best = NULL;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *run = &scale->run[i];
        if (run->state == OST_SCALE_DONE && run->levels > 1 && run->cycles > 0 &&
            (!best || run->ranks > best->ranks || (run->ranks == best->ranks && run->unknowns > best->unknowns)))
            best = run;
    }
    return best;
}

double ost_scale_memory_rate(const OstScale *scale)
{
    double best = 0.0;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *run = &scale->run[i];
        if (run->state == OST_SCALE_DONE && !run->crowded && run->stage[OST_STAGE_SOLVE] > 0.0)
            best = fmax(best, entry_bytes * run->work.mean / run->stage[OST_STAGE_SOLVE]);
    }
    return best * scale->here.ranks;
}

void ost_scale_first_limit(const OstScaleForecast *forecast, int count, char *text, size_t size)
{
    int f = 0;
    while (f < count && forecast[f].efficiency >= 0.5)
        f++;
    if (f == count) {
        snprintf(text, size, "nothing up to %.0f ranks: memory is %.0f %% of an iteration", forecast[count - 1].ranks,
                 100.0 * forecast[count - 1].efficiency);
        return;
    }
    const OstScaleForecast *first = &forecast[f];
    int worst = OST_SCALE_MESSAGES;
    for (int p = worst; p < OST_SCALE_PARTS; p++)
        if (first->part[p] > first->part[worst])
            worst = p;
    const double share = 100.0 * first->part[worst] / first->seconds;
    const double of_rank = first->unknowns / first->ranks;
    if (worst == OST_SCALE_MESSAGES)
        snprintf(
            text, size,
            "by %.0f ranks, %.3g unknowns each, the messages' latency: %.0f %% of an iteration, %.0f messages, most "
            "of them on level %d of %d",
            first->ranks, of_rank, share, first->messages, first->slowest_level, first->levels);
    else if (worst == OST_SCALE_COARSEST)
        snprintf(text, size,
                 "by %.0f ranks, %.3g unknowns each, the coarsest level, of %.3g unknowns: %.0f %% of an iteration",
                 first->ranks, of_rank, first->coarsest, share);
    else
        snprintf(text, size, "by %.0f ranks, %.3g unknowns each, %s: %.0f %% of an iteration", first->ranks, of_rank,
                 worst == OST_SCALE_BYTES ? "the messages' bytes" : "sums over all ranks", share);
}

void ost_scale_sent(const OstScaleRun *run, OstScaleCount *messages, OstScaleCount *bytes)
{
    *messages = run->iteration.messages;
    *bytes = run->iteration.bytes;
    for (int l = 0; l < run->levels; l++) {
        messages->mean += run->level[l].messages.mean;
        messages->most += run->level[l].messages.most;
        bytes->mean += run->level[l].bytes.mean;
        bytes->most += run->level[l].bytes.most;
    }
}

int ost_scale_check(const OstScale *scale, const OstScaleRun *run, const OstScaleRun **from, OstScaleForecast *forecast)
{
    *from = NULL;
    if (run->state != OST_SCALE_DONE || run->levels < 2 || run->cycles == 0)
        return 0;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *other = &scale->run[i];
        if (other->state == OST_SCALE_DONE && other->target == run->target && other->levels > 1 && other->cycles > 0 &&
            other->ranks > 1 && other->ranks < run->ranks && (!*from || other->ranks > (*from)->ranks))
            *from = other;
    }
    if (!*from && run->ranks > 1)
        *from = run;
    if (!*from)
        return 0;
    ost_scale_foretell(*from, &scale->here, run->ranks, (double)run->unknowns, forecast);
    return 1;
}

double ost_scale_most_bytes(const OstScale *scale)
{
    double most = 0.0;
    for (int i = 0; i < scale->run_count; i++)
        most = fmax(most, scale->run[i].bytes);
    return most;
}

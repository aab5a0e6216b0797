/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/watch.h"

#include <math.h>

void ost_watch_start(OstWatch *watch, double norm)
{
    watch->count = 0;
    watch->residual.first = watch->residual.least = norm;
}

static void follow(OstTrack *track, int count, double norm)
{
    track->before[count % OST_WATCH_WINDOW] = track->least;
    if (norm < track->least)
        track->least = norm;
}

void ost_watch_add(OstWatch *watch, double norm, double weight)
{
    const double energy = sqrt(weight);
    if (watch->count == 0)
        watch->energy.first = watch->energy.least = energy;
    follow(&watch->residual, watch->count, norm);
    follow(&watch->energy, watch->count, energy);
    watch->count++;
}

static double mean(double ratio, int count)
{
    return pow(ratio, 1.0 / count);
}

static double window_factor(const OstTrack *track, int count)
{
    if (count < OST_WATCH_WINDOW)
        return count > 0 ? mean(track->least / track->first, count) : 1.0;
    return mean(track->least / track->before[count % OST_WATCH_WINDOW], OST_WATCH_WINDOW);
}

double ost_watch_factor(const OstWatch *watch)
{
    return fmin(window_factor(&watch->residual, watch->count), window_factor(&watch->energy, watch->count));
}

double ost_watch_whole_factor(const OstWatch *watch)
{
    return watch->count > 0 ? mean(watch->residual.least / watch->residual.first, watch->count) : 1.0;
}

double ost_watch_remaining(const OstWatch *watch, double target)
{
    if (watch->count < 2 * OST_WATCH_WINDOW || watch->residual.least <= target)
        return 0.0;
    const double pace = log(ost_watch_factor(watch));
    return pace < 0.0 ? log(target / watch->residual.least) / pace : INFINITY;
}

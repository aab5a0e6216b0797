/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/watch.h"

#include <math.h>

void ost_watch_start(OstWatch *watch, double norm)
{
    watch->count = 0;
    watch->first = watch->least = norm;
}

void ost_watch_add(OstWatch *watch, double norm)
{
    watch->before[watch->count++ % OST_WATCH_WINDOW] = watch->least;
    if (norm < watch->least)
        watch->least = norm;
}

double ost_watch_factor(const OstWatch *watch)
{
    if (watch->count < OST_WATCH_WINDOW)
        return ost_watch_whole_factor(watch);
    return pow(watch->least / watch->before[watch->count % OST_WATCH_WINDOW], 1.0 / OST_WATCH_WINDOW);
}

double ost_watch_whole_factor(const OstWatch *watch)
{
    return watch->count > 0 ? pow(watch->least / watch->first, 1.0 / watch->count) : 1.0;
}

double ost_watch_remaining(const OstWatch *watch, double target)
{
    if (watch->count < 2 * OST_WATCH_WINDOW || watch->least <= target)
        return 0.0;
    const double pace = log(ost_watch_factor(watch));
    return pace < 0.0 ? log(target / watch->least) / pace : INFINITY;
}

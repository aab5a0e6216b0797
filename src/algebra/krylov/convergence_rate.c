/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/convergence_rate.h"

#include <math.h>

void ost_convergence_start(OstConvergence *pace, double norm)
{
    pace->count = 0;
    pace->residual.first = pace->residual.least = norm;
}

static void follow(OstTrack *track, int count, double norm)
{
    track->before[count % OST_CONVERGENCE_WINDOW] = track->least;
    if (norm < track->least)
        track->least = norm;
}

void ost_convergence_add(OstConvergence *pace, double norm, double weight)
{
    const double energy = sqrt(weight);
    if (pace->count == 0)
        pace->energy.first = pace->energy.least = energy;
    follow(&pace->residual, pace->count, norm);
    follow(&pace->energy, pace->count, energy);
    pace->count++;
}

static double mean(double ratio, int count)
{
    return pow(ratio, 1.0 / count);
}

static double window_factor(const OstTrack *track, int count)
{
    if (count < OST_CONVERGENCE_WINDOW)
        return count > 0 ? mean(track->least / track->first, count) : 1.0;
    return mean(track->least / track->before[count % OST_CONVERGENCE_WINDOW], OST_CONVERGENCE_WINDOW);
}

double ost_convergence_factor(const OstConvergence *pace)
{
    return fmin(window_factor(&pace->residual, pace->count), window_factor(&pace->energy, pace->count));
}

double ost_convergence_whole_factor(const OstConvergence *pace)
{
    return pace->count > 0 ? mean(pace->residual.least / pace->residual.first, pace->count) : 1.0;
}

double ost_convergence_remaining(const OstConvergence *pace, double target)
{
    if (pace->count < 2 * OST_CONVERGENCE_WINDOW || pace->residual.least <= target)
        return 0.0;
    const double gain = log(ost_convergence_factor(pace));
    return gain < 0.0 ? log(target / pace->residual.least) / gain : INFINITY;
}

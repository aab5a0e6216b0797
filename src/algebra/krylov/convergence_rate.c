/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/convergence_rate.h"

#include <math.h>

void ost_convergence_start(OstConvergence *convergence, double norm)
{
    convergence->count = 0;
    convergence->residual.first = convergence->residual.least = norm;
}

static void follow(OstTrack *track, int count, double norm)
{
    track->before[count % OST_CONVERGENCE_WINDOW] = track->least;
    if (norm < track->least)
        track->least = norm;
}

void ost_convergence_add(OstConvergence *convergence, double norm, double weight)
{
    const double energy = sqrt(weight);
    if (convergence->count == 0)
        convergence->energy.first = convergence->energy.least = energy;
    follow(&convergence->residual, convergence->count, norm);
    follow(&convergence->energy, convergence->count, energy);
    convergence->count++;
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

double ost_convergence_factor(const OstConvergence *convergence)
{
    return fmin(window_factor(&convergence->residual, convergence->count),
                window_factor(&convergence->energy, convergence->count));
}

double ost_convergence_whole_factor(const OstConvergence *convergence)
{
    return convergence->count > 0 ? mean(convergence->residual.least / convergence->residual.first, convergence->count)
                                  : 1.0;
}

double ost_convergence_remaining(const OstConvergence *convergence, double target)
{
    if (convergence->count < 2 * OST_CONVERGENCE_WINDOW || convergence->residual.least <= target)
        return 0.0;
    const double gain = log(ost_convergence_factor(convergence));
    return gain < 0.0 ? log(target / convergence->residual.least) / gain : INFINITY;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/convergence_rate.h"

#include <math.h>

/* Iterations in which a pass gains nothing. */
enum { STAGNATION = 500 };

void ost_convergence_start(OstConvergence *convergence, double norm)
{
    convergence->count = 0;
    convergence->residual.first = convergence->residual.least = norm;
    ost_convergence_begin_pass(convergence);
}

void ost_convergence_begin_pass(OstConvergence *convergence)
{
    convergence->pass = convergence->halved = convergence->count;
    convergence->next_residual = convergence->next_energy = INFINITY;
}

static void note_gain(OstConvergence *convergence, double norm, double energy)
{
    if (!(norm <= convergence->next_residual || energy <= convergence->next_energy))
        return;
    convergence->halved = convergence->count;
    convergence->next_residual = fmin(convergence->next_residual, 0.5 * norm);
    convergence->next_energy = fmin(convergence->next_energy, 0.5 * energy);
}

int ost_convergence_stagnates(const OstConvergence *convergence)
{
    const int since = convergence->count - convergence->halved;
    return since >= STAGNATION && 3 * since > convergence->count - convergence->pass;
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
    note_gain(convergence, norm, energy);
}

static double mean(double ratio, int count)
{
    return pow(ratio, 1.0 / count);
}

static double whole_factor(const OstTrack *track, int count)
{
    return mean(track->least / track->first, count);
}

static double window_factor(const OstTrack *track, int count)
{
    if (count < OST_CONVERGENCE_WINDOW)
        return count > 0 ? whole_factor(track, count) : 1.0;
    return mean(track->least / track->before[count % OST_CONVERGENCE_WINDOW], OST_CONVERGENCE_WINDOW);
}

double ost_convergence_factor(const OstConvergence *convergence)
{
    return fmin(window_factor(&convergence->residual, convergence->count),
                window_factor(&convergence->energy, convergence->count));
}

double ost_convergence_whole_factor(const OstConvergence *convergence)
{
    const int count = convergence->count;
    if (count == 0)
        return 1.0;
    return fmin(whole_factor(&convergence->residual, count), whole_factor(&convergence->energy, count));
}

double ost_convergence_remaining(const OstConvergence *convergence, double target)
{
    if (convergence->count < 2 * OST_CONVERGENCE_WINDOW || convergence->residual.least <= target)
        return 0.0;
    const double gain = log(ost_convergence_factor(convergence));
    return gain < 0.0 ? log(target / convergence->residual.least) / gain : INFINITY;
}

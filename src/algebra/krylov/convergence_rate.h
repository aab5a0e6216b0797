/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_CONVERGENCE_RATE_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_CONVERGENCE_RATE_H

enum { OST_CONVERGENCE_WINDOW = 20 };

/* A norm that goes up and down in conjugate gradients: the least one so far is what counts. */
typedef struct OstTrack {
    double first, least;
    double before[OST_CONVERGENCE_WINDOW]; /* the least ones of the last iterations */
} OstTrack;

/* How a residual falls, in the norm that is asked for and in that of the preconditioner, sqrt(r·z): while the first
 * still rises (thin bodies, uneven stiffness), the second, close to the norm of the energy, may long be falling. */
typedef struct OstConvergence {
    int count; /* iterations so far */
    OstTrack residual, energy;
} OstConvergence;

/* Local, all. `weight` is r·z. */
void ost_convergence_start(OstConvergence *pace, double norm);
void ost_convergence_add(OstConvergence *pace, double norm, double weight);

/* By what an iteration of the last window multiplied the faster of the two; and the residual since the start (geometric
 * means). */
double ost_convergence_factor(const OstConvergence *pace);
double ost_convergence_whole_factor(const OstConvergence *pace);

/* How many more iterations it takes to reach `target` at the pace of the last window: INFINITY if there is none, 0 if
 * it is too early to say (two windows). */
double ost_convergence_remaining(const OstConvergence *pace, double target);

#endif

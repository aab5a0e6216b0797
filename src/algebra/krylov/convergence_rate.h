/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_CONVERGENCE_RATE_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_CONVERGENCE_RATE_H

enum { OST_CONVERGENCE_WINDOW = 20 };

/* A norm of the residual. In conjugate gradients it goes up and down, so the smallest so far is what counts. */
typedef struct OstTrack {
    double first, least;
    double before[OST_CONVERGENCE_WINDOW]; /* `least` before each of the last iterations */
} OstTrack;

/* How the residual falls, in the 2-norm and in the norm of the preconditioner, sqrt(r·z). The second is close to the
 * energy norm of the error and may fall while the first still rises (thin bodies, uneven stiffness). */
typedef struct OstConvergence {
    int count; /* iterations so far */
    OstTrack residual, energy;
} OstConvergence;

/* Local, all. `weight` is r·z. */
void ost_convergence_start(OstConvergence *convergence, double norm);
void ost_convergence_add(OstConvergence *convergence, double norm, double weight);

/* The convergence rate, by which an iteration multiplies the norm (geometric mean): over the last window and the norm
 * that falls faster; over all iterations and the 2-norm. */
double ost_convergence_factor(const OstConvergence *convergence);
double ost_convergence_whole_factor(const OstConvergence *convergence);

/* Iterations still needed to reach `target` at the convergence rate of the last window: INFINITY if the norm does not
 * fall, 0 before two windows are complete. */
double ost_convergence_remaining(const OstConvergence *convergence, double target);

#endif

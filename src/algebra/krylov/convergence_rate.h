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
    /* of the pass at hand, which began from a true residual: the iteration before it, the last one that halved a norm,
     * and the norms that are to be halved next */
    int pass, halved;
    double next_residual, next_energy;
} OstConvergence;

/* Local, all. `weight` is r·z. */
void ost_convergence_start(OstConvergence *convergence, double norm);
void ost_convergence_begin_pass(OstConvergence *convergence);
void ost_convergence_add(OstConvergence *convergence, double norm, double weight);

/* Has the pass gone on so long without halving either norm, more than a third of its iterations, that it never will?
 * The slowest that still reach 1e-8 halve one in 250 at first, and more quickly once the smallest eigenvalues are
 * found. */
int ost_convergence_stagnates(const OstConvergence *convergence);

/* The convergence rate, by which an iteration multiplies the norm (geometric mean): over the last window and over all
 * iterations, of the norm that falls faster. */
double ost_convergence_factor(const OstConvergence *convergence);
double ost_convergence_whole_factor(const OstConvergence *convergence);

/* Iterations still needed to reach `target` at the convergence rate of the last window: INFINITY if the norm does not
 * fall, 0 before two windows are complete. */
double ost_convergence_remaining(const OstConvergence *convergence, double target);

#endif

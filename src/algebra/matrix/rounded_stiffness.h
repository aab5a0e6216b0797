/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_ROUNDED_STIFFNESS_H
#define ORTHOSTAT_ALGEBRA_MATRIX_ROUNDED_STIFFNESS_H

#include "algebra/matrix/block_matrix.h"

/* The perturbation of a stiffness K by rounding its entries: each is off by up to 2^-53 of its size, K_ij and K_ji
 * alike. Its effect on a displacement is estimated from random samples of the signs, as their root mean square. */

/* Local. The force (K' - K) u of random sample `which`: every entry of K' is 2^-53 of its size above or below that of
 * K. The signs depend on the nodes' labels alone, so they are the same on any number of ranks. The ghosts of u are set;
 * `force` has 3 × rows numbers. */
void ost_rounded_stiffness_force(const OstBlockMatrix *matrix, const double *u, int which, double *force);

/* Local. The expected rounding error of each component of A u if its terms are rounded at random: DBL_EPSILON times the
 * root of the sum of their squares. The ghosts of u are set; `rounding` has 3 × rows numbers. */
void ost_term_rounding(const OstBlockMatrix *matrix, const double *u, double *rounding);

/* The sizes found with the samples so far. */
typedef struct OstSamples {
    int count;
    double squares;
} OstSamples;

static inline void ost_samples_add(OstSamples *samples, double size)
{
    samples->count++;
    samples->squares += size * size;
}

/* Local. The root mean square, and its relative standard error if one soft mode dominates, as in a badly conditioned
 * body (its share is then normally distributed); with more modes it is smaller. */
double ost_samples_size(const OstSamples *samples);
double ost_samples_spread(const OstSamples *samples);

/* Local. Is `size` above the limit by more than three standard errors? Yes if it is NAN. */
int ost_surely_beyond(double size, double spread, double limit);

/* Local. Are more samples needed? Up to `fewest` always; up to `most` while the limit is within three standard errors.
 */
int ost_samples_undecided(const OstSamples *samples, double limit, int fewest, int most);

#endif

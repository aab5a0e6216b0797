/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_ROUNDED_STIFFNESS_H
#define ORTHOSTAT_ALGEBRA_MATRIX_ROUNDED_STIFFNESS_H

#include "algebra/matrix/block_matrix.h"

/* What double precision leaves unsaid of a stiffness: each of its entries may be off by 2^-53 of itself, both of a pair
 * alike, as one number was rounded. What that does to a displacement is looked at by throws of the signs at random, and
 * told by the root of the mean square over them. */

/* Local. The force (K' - K) u, every entry of K' being up or down by 2^-53 of K's; `which` of many such throws, whose
 * signs follow the nodes' labels and so are the same on any ranks. u comes with its ghosts; `force` has 3 × rows
 * numbers. */
void ost_rounded_stiffness_force(const OstBlockMatrix *matrix, const double *u, int which, double *force);

/* Sizes that throws had. */
typedef struct OstSamples {
    int count;
    double squares;
} OstSamples;

static inline void ost_samples_add(OstSamples *throws, double size)
{
    throws->count++;
    throws->squares += size * size;
}

/* Local. The root of the mean square, and its standard error over itself. That is for one soft mode, which is what
 * there is to find in a badly conditioned body: its share is normally distributed. With more modes it is less. */
double ost_samples_size(const OstSamples *throws);
double ost_samples_spread(const OstSamples *throws);

/* Local. Is `size` surely beyond the limit, by three standard errors? What is no number is. */
int ost_surely_beyond(double size, double spread, double limit);

/* Local. Are more throws called for? They are below `fewest`, and below `most` while the limit is within three standard
 * errors. */
int ost_samples_undecided(const OstSamples *throws, double limit, int fewest, int most);

#endif

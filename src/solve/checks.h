/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_CHECKS_H
#define ORTHOSTAT_SOLVE_CHECKS_H

#include "assembly/supports.h"
#include "orthostat/result.h"

/* Collective. Computes the reactions and result->checks from displacement and loads, with internal forces summed tet by
 * tet, without the assembled matrix, so that a mistake in it cannot hide. `rhs_norm` is the norm of the right-hand side
 * solved for. Objects (ost_object) with the numbers to what does not hold: finite values, the true residual, forces and
 * moments in balance, strain energy equal to the work (Clapeyron), a digit left by rounding.
 *
 * Digits. With M the preconditioner and k the condition number of M^-1 K, in the norms of M and M^-1,
 *     |u - u*| / |u*|  <=  k |f - K u| / |f|
 * (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 7.1, for the split preconditioned system). k comes
 * from the Lanczos coefficients of the solve, which see the part of the spectrum that f excites, and approach it from
 * below; the residual is that of the checks, with what rounding may add to it: the stiffness, and u itself, are held to
 * 1e-16 only, and the residual that this hides is about DBL_EPSILON |K| |u|. It is measured in the 2-norm, which stands
 * in for that of M^-1: an estimate, then, not a bound. (With MUMPS for M, k is about 1 and says no more than that the
 * factors are good; PLAIN has no k, and states no digits.) -log10 of it is the digits. Fewer digits than the requested
 * residual leaves are the user's choice; less than one digit left by rounding alone is objected to.
 *
 * The sums are not compensated, because the limit is u's own: a displacement rounded to double leaves a residual of
 * about DBL_EPSILON |K| |u| however exactly that is summed. Measured where it is worst, on an inclusion 1e9 times
 * stiffer than what is around it: 4.61e-6 summed in double, 4.61e-6 summed in 64 bits (the same displacement). Nothing
 * is gained before u has more bits. */
OstStatus ost_result_check(OstResult *result, const OstSupports *supports, double requested_residual, double rhs_norm);

/* Local. Holds something against a result. */
void ost_object(OstResult *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif

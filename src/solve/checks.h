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
 * Digits. The solver estimates the error from the preconditioner applied to the true residual and to what rounding
 * leaves of the stiffness: with multigrid in the norm of the energy, by the smallest Ritz value of the solve; with
 * factors the displacement's own (algebra/energy_error.h), or what their steps would still move it, if that is more
 * (algebra/refine.h). It is an estimate, not a bound: the Ritz value comes from above, and a displacement may be less
 * right where little energy is. PLAIN keeps its coefficients to itself, and states no digits. -log10 of it is the
 * digits. Fewer digits than the requested residual leaves are the user's choice; less than one digit left by rounding
 * is objected to. The 2-norm of the
 * residual times the condition, which needs no preconditioner, is of no use where stiffness is uneven: it takes the
 * residual at a stiff inclusion for one at what is soft, and denied digits to answers that held five.
 *
 * The sums are not compensated, because the limit is u's own: a displacement rounded to double leaves a residual of
 * about DBL_EPSILON |K| |u| however exactly that is summed. Measured where it is worst, on an inclusion 1e9 times
 * stiffer than what is around it: 4.61e-6 summed in double, 4.61e-6 summed in 64 bits (the same displacement). Nothing
 * is gained before u has more bits. */
OstStatus ost_result_check(OstResult *result, const OstSupports *supports, double requested_residual, double rhs_norm);

/* Local. Holds something against a result. */
void ost_object(OstResult *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_CHECKS_H
#define ORTHOSTAT_SOLVE_CHECKS_H

#include "assembly/supports.h"
#include "orthostat/result.h"

/* The right-hand side that was solved for, and the unknowns found. */
typedef struct OstSolvedFor {
    double norm;
    double work; /* of it on the unknowns */
} OstSolvedFor;

/* Collective. Computes the reactions and result->checks from displacement and loads, with internal forces summed tet by
 * tet, without the assembled matrix, so that a mistake in it cannot hide. Objects (ost_object) with the numbers to what
 * does not hold: finite values, the true residual, forces and moments in balance, strain energy equal to the work
 * (Clapeyron), a digit left by rounding, and one of the forces.
 *
 * Digits. The solver estimates the error from the preconditioner applied to the true residual and to what rounding
 * leaves of the stiffness: with multigrid in the norm of the energy or of the displacement, whichever is more, by the
 * smallest Ritz value of the solve; with factors the displacement's own (algebra/energy_error.h), or what their steps
 * would still move it, if that is more (algebra/refine.h). It is an estimate, not a bound: the Ritz value comes from
 * above. PLAIN keeps its coefficients to itself, and states no digits. What the work misses of the energy is an error
 * too. -log10 of the most is the digits. Fewer digits than the requested residual leaves are the user's choice; less
 * than one digit left by rounding is objected to. The 2-norm of the residual times the condition, which needs no
 * preconditioner, is of no use where stiffness is uneven: it takes the residual at a stiff inclusion for one at what is
 * soft, and denied digits to answers that held five.
 *
 * Forces. A displacement may hold eleven digits beside a support that takes the whole body along, and its strains none:
 * neither residual nor error estimate sees that, both being over what the support does to the unknowns. The forces'
 * error is the most of what is measured, the imbalances of force, moment and energy, and of the displacement's error
 * over what strains the body: over the strain energy, or, of factors, the displacement less its mean. The imbalances
 * alone would not do: their size is that of rounded reactions as well, whose sum hides in the square root of their
 * number (a cube of 9261 vertices, moved by 1 where it deforms by 1e-10: balanced to 0.06, stresses 330 times too
 * large).
 *
 * The sums are not compensated, because the limit is u's own: a displacement rounded to double leaves a residual of
 * about DBL_EPSILON |K| |u| however exactly that is summed. Measured where it is worst, on an inclusion 1e9 times
 * stiffer than what is around it: 4.61e-6 summed in double, 4.61e-6 summed in 64 bits (the same displacement). Nothing
 * is gained before u has more bits. */
OstStatus ost_result_check(OstResult *result, const OstSupports *supports, double requested_residual,
                           const OstSolvedFor *rhs);

/* Local. Holds something against a result. */
void ost_object(OstResult *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_ENERGY_ERROR_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_ENERGY_ERROR_H

#include "algebra/krylov/preconditioner.h"

/* Estimates how far u is from the solution u* of A u = f. With r = f - A u, a preconditioner M and l the smallest
 * eigenvalue of M^-1 A, the error in the energy norm is
 *     |u - u*|_A = |r|_{A^-1}  <=  sqrt(r·M^-1 r / l),      relative to |u*|_A = sqrt(f·u*)
 * (Axelsson and Kaporin, Error norm estimation and stopping criteria in preconditioned conjugate gradient iterations,
 * Numer. Linear Algebra Appl. 8, 2001). l comes from the Lanczos coefficients of the solve, which approach it from
 * above: so this is an estimate, no bound.
 *
 * One region of a body may have nearly all the energy and another nearly all the displacement. So the 2-norm
 * |M^-1 r| / (l |u|) is computed too, and the larger of the two is the error.
 *
 * If M is the factors of A, M^-1 r is the error itself. Then the error is its 2-norm over that of u, and l is not used.
 *
 * Rounding has perturbed each entry of A by 2^-53 of its size. Its effect is estimated from random samples of such
 * rounding errors (algebra/matrix/rounded_stiffness.h). The force of one sample is added to r, so that one application
 * of the preconditioner estimates both errors. If that estimate is above 1e-6, the two are estimated apart, and
 * rounding from several samples: the error of a badly conditioned body lies in one softest mode, of which one sample
 * may have little. More samples follow where the error is close to ost_least_digit, which decides whether the solution
 * is refused.
 *
 * Where rounding hides u (`compensated`), the factors may miss the softest mode too. Then each sample is solved by CG
 * preconditioned by them, with compensated products (algebra/matrix/compensated_step.h). */
typedef struct OstEnergyError {
    double whole;  /* relative error of u. NAN: M is not positive definite. INFINITY, and `rounding` too: f·u <= 0, or
                      CG preconditioned by the factors finds A not positive definite or does not converge */
    double energy; /* the same in the energy norm alone, as it matters for stresses; equals `whole` if M is factors */
    double rounding; /* the share of `whole` that rounding of A explains; 0 if `whole` is at most 1e-6 */
    double spread;   /* relative standard error of `rounding`; 0 if it was not sampled */
    int hidden;      /* `whole` is above 1e-6 and far above `energy`: l may be that of the stiff region only, and more
                        iterations are needed */
} OstEnergyError;

/* The relative error that leaves one digit of a displacement. */
extern const double ost_least_digit;

/* What to do where rounding leaves no digit. */
extern const char *const ost_rounding_remedy;

/* Collective. Applies the preconditioner once; if the error is above 1e-6, 3 times; if it is due to rounding, 10 times;
 * near ost_least_digit up to 66 times. CG preconditioned by factors takes two or three steps for each of these, at most
 * 40. `compensated`: rounding is so close that r is computed by ost_compensated_residual. */
OstStatus ost_energy_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                           const double *f, const double *u, int compensated, OstEnergyError *error);

#endif

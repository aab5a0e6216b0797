/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_ENERGY_ERROR_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_ENERGY_ERROR_H

#include "algebra/krylov/preconditioner.h"

/* How far u is from the solution u* of A u = f, in the norm of the energy. With r = f - A u, M a preconditioner and l
 * the smallest eigenvalue of M^-1 A, |u - u*|_A = |r|_{A^-1}  <=  sqrt(r·M^-1 r / l),      |u*|_A = sqrt(f·u*)
 * (Axelsson and Kaporin, Error norm estimation and stopping criteria in preconditioned conjugate gradient iterations,
 * Numer. Linear Algebra Appl. 8, 2001). l comes from the Lanczos coefficients of the solve and approaches the
 * eigenvalue from above: an estimate, then, but one that sees how stiff each unknown is, where the 2-norm of r takes
 * all alike.
 *
 * Where the energy is in one part of a body and the displacement in another, that tells little of the displacement:
 * |M^-1 r| / (l |u|), in the 2-norm, is told where it is more (no bound, but the size of the next step over what of the
 * way it goes).
 *
 * Where M is the factors of A, M^-1 r is the error itself: then its 2-norm over that of u is told, which is what is
 * asked of a displacement, and owes nothing to l.
 *
 * A itself is rounded, each entry by 2^-53 of itself: what that leaves is told by the same norm of a throw of such
 * roundings (algebra/rounded_stiffness.h). It is added to r, so that one application of the preconditioner tells both.
 * Where that leaves less than six digits, the two are told apart, and rounding by several throws: what rounding does to
 * a badly conditioned body is its share in one softest mode, which one throw may miss. So may factors, by as much as
 * they like, where u itself is hidden by rounding (`compensated`): there they are led to A^-1 of each throw
 * (algebra/exact_step.h). Near to the least digit, where a body is refused or not, there are more throws. */
typedef struct OstEnergyError {
    double whole;    /* over |u|; NAN where M is not positive definite, INFINITY where f·u <= 0, as of no solution, or
                        where factors are led to find that A is not positive definite, or to nothing that settles:
                        then `rounding` as well */
    double energy;   /* in the norm of the energy alone (`whole` where M is factors), as it is for stresses */
    double rounding; /* of `whole`, what rounding of A explains; 0 where six digits are left, and nobody asked */
    double spread;   /* standard error of `rounding`, over it; 0 where there is none */
    int hidden;      /* less than six digits are left, and by the energy alone it would have been far more: then l, too,
                        may be that of the one part, and more iterations are what tells */
} OstEnergyError;

/* The relative error that leaves one digit. */
extern const double ost_least_digit;

/* Collective. Applies the preconditioner once, or where less than six digits are left, three times; ten times if they
 * are lost to rounding, and up to 66 times near to the least digit. Factors that are led take two or three each time,
 * 40 at most. `compensated`: rounding is so near that r is summed by ost_compensated_residual. */
OstStatus ost_energy_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                           const double *f, const double *u, int compensated, OstEnergyError *error);

#endif

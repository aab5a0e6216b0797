/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_ENERGY_ERROR_H
#define ORTHOSTAT_ALGEBRA_ENERGY_ERROR_H

#include "algebra/cg.h"

/* How far u is from the solution u* of A u = f, in the norm of the energy. With r = f - A u, M a preconditioner and l
 * the smallest eigenvalue of M^-1 A, |u - u*|_A = |r|_{A^-1}  <=  sqrt(r·M^-1 r / l),      |u*|_A = sqrt(f·u*)
 * (Axelsson and Kaporin, Error norm estimation and stopping criteria in preconditioned conjugate gradient iterations,
 * Numer. Linear Algebra Appl. 8, 2001). l comes from the Lanczos coefficients of the solve and approaches the
 * eigenvalue from above: an estimate, then, but one that sees how stiff each unknown is, where the 2-norm of r takes
 * all alike. A itself is rounded: what that leaves is told by the same norm of a residual that every term of A u adds
 * its rounding to, with signs at random. */
typedef struct OstEnergyError {
    double residual; /* by r, over |u|_A */
    double rounding; /* by rounding of A, over |u|_A */
} OstEnergyError;

/* Collective. Applies the preconditioner twice. `exact`: r is summed by ost_exact_residual. INFINITY where f·u <= 0,
 * which no solution has. */
OstStatus ost_energy_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                           const double *f, const double *u, int exact, OstEnergyError *error);

#endif

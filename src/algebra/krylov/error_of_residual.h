/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_ERROR_OF_RESIDUAL_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_ERROR_OF_RESIDUAL_H

#include "algebra/krylov/preconditioner.h"

/* Collective. The error e = A^-1 r of an approximate solution that leaves the residual r. The residual may be that of
 * other equations than A u = f: of those that A was rounded from, whose solution is then u + e to first order.
 *
 * Conjugate gradients with compensated products (algebra/matrix/compensated_step.h) go on until no more than the share
 * `missing` of e is missing, in the norm of the energy, by |e - e_k|_A² <= r_k·M^-1 r_k / smallest beside the |e_k|_A²
 * that the steps have found (Hestenes and Stiefel, J. Res. Nat. Bur. Standards 49, 1952), and by the last step in the
 * 2-norm. If that takes more than 200 steps, e is enlarged by the part of its energy that may be missing. If `missing`
 * is 1, one application of the preconditioner over `smallest` is taken for e: each part of it is too large, by up to 1
 * / smallest.
 *
 * `smallest` is an eigenvalue of M^-1 A, about. `residual` and `error` have 3 × rows numbers of any unit. *found: 0 if
 * A or M proves not to be positive definite; then `error` means nothing. */
OstStatus ost_error_of_residual(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                                double missing, const double *residual, double *error, int *found);

#endif

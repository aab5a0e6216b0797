/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_ERROR_OF_RESIDUAL_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_ERROR_OF_RESIDUAL_H

#include "algebra/krylov/preconditioner.h"

/* How the error is found: by one application of the preconditioner, each part of it being too large by up to 1 /
 * smallest, or to a few percent. */
typedef enum { OST_ERROR_AT_MOST, OST_ERROR_ITSELF } OstErrorDepth;

/* Collective. The error e = A^-1 r of an approximate solution that leaves the residual r. The residual may be that of
 * other equations than A u = f: of those that A was rounded from, whose solution is then u + e to first order.
 *
 * Conjugate gradients with compensated products (algebra/matrix/compensated_step.h) go on until what is missing of e is
 * a tenth of it, both in the norm of the energy, |e - e_k|_A² <= r_k·M^-1 r_k / smallest beside the |e_k|_A² that the
 * steps have found (Hestenes and Stiefel, J. Res. Nat. Bur. Standards 49, 1952), and by the last step in the 2-norm. If
 * that takes more than 60 steps, e is enlarged by the part of its energy that may be missing.
 *
 * `smallest` is an eigenvalue of M^-1 A, about. `residual` and `error` have 3 × rows numbers of any unit. *found: 0 if
 * A or M proves not to be positive definite; then `error` means nothing. */
OstStatus ost_error_of_residual(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                                OstErrorDepth depth, const double *residual, double *error, int *found);

#endif

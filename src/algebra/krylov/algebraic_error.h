/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_ALGEBRAIC_ERROR_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_ALGEBRAIC_ERROR_H

#include "algebra/krylov/lanczos.h"

/* How far conjugate gradients still are from the solution, in the norm of the energy, |e|_A. Step k lowers |e|_A² by
 * alpha_k r_k·z_k (Hestenes and Stiefel 1952): so the steps since the iterate u_k tell of its error, with a delay
 * (Strakos and Tichy, ETNA 13, 2002). How the errors of past iterates compare with what was gained from there tells of
 * the present one, from which nothing was gained yet (as Meurant, Papez and Tichy, Numer. Algorithms 88, 2021, find
 * the delay).
 *
 * The bound is that of Gauss-Radau quadrature (Golub and Meurant), with half the smallest eigenvalue of the Lanczos
 * matrix in place of a number below all eigenvalues: it is one once that eigenvalue is found to a factor of two, and
 * far too large where such eigenvalues are few, as the iteration has done with them then.
 *
 * Seen on tubes of ratio 1 to 1e6 and nu of .3 to .499, linear and quadratic, from the third step on: estimate 0.45 to
 * 6.6 of the error, bound 0.9 to 12. */
typedef struct OstAlgebraicError {
    double size;     /* |u|_A, of an iteration that began with u = 0 */
    double estimate; /* INFINITY before the third step, and while steps gain more and more */
    double bound;
} OstAlgebraicError;

/* Local. The error after all steps in `lanczos`, which are not empty. */
void ost_algebraic_error(const OstLanczos *lanczos, OstAlgebraicError *error);

/* Local. By how much a step multiplies the error at present, about. */
double ost_algebraic_error_rate(const OstLanczos *lanczos, const OstAlgebraicError *error);

#endif

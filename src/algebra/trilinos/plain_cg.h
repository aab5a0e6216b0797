/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_PLAIN_CG_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_PLAIN_CG_H

#include "algebra/krylov/cg.h"

/* Collective. As ost_cg_solve on the unscaled matrix, by AztecOO's conjugate gradients, which need a preconditioner
 * that is not flexible, and keep their coefficients to themselves. */
OstStatus ost_aztec_solve(const OstBlockMatrix *matrix, const OstPreconditioner *preconditioner, const double *f,
                          double *u, OstGoal *goal);

#endif

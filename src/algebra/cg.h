/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_CG_H
#define ORTHOSTAT_ALGEBRA_CG_H

#include "algebra/refine.h"
#include "algebra/scaling.h"

/* z = M^-1 r, M symmetric positive definite, on scaled vectors of 3 × rows numbers; collective, all ranks succeed or
 * fail together. `flexible`: M differs from one application to the next (inner iterations). `factors`: M is A, but for
 * rounding. `apply` must not write r. */
typedef struct OstPreconditioner {
    void *data;
    OstStatus (*apply)(void *data, const double *r, double *z);
    int flexible;
    int factors;
} OstPreconditioner;

/* A u = f as it is iterated on: A' u' = f' of a scaling, whose products are S (A (S^T u')), or A itself. */
typedef struct OstCgSystem {
    const OstBlockMatrix *matrix; /* A */
    const OstScaling *scaling;    /* S, or NULL: the identity */
} OstCgSystem;

/* Collective. Improves u towards A u = f by preconditioned conjugate gradients, as ost_refine, in the unscaled norm.
 * Fills the report's condition_estimate, from the first run's coefficients, error_estimate, rounding_error and its
 * spread. Raises OST_NOT_CONVERGED where p·Ap is negative beyond rounding: the matrix is indefinite, which no
 * preconditioner mends. Where rounding hides p·Ap, factors are believed, which makes it iterative refinement; others
 * stall. */
OstStatus ost_cg_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *f, double *u,
                       OstGoal *goal, OstSolveReport *report);

#endif

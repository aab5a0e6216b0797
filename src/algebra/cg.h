/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_CG_H
#define ORTHOSTAT_ALGEBRA_CG_H

#include "algebra/scaling.h"
#include "orthostat/solver.h"

/* z = M^-1 r, M symmetric positive definite, on scaled vectors of 3 × rows numbers; collective, all ranks succeed or
 * fail together. `flexible`: M differs from one application to the next (inner iterations). `apply` must not write r.
 */
typedef struct OstPreconditioner {
    void *data;
    OstStatus (*apply)(void *data, const double *r, double *z);
    int flexible;
} OstPreconditioner;

/* A u = f as it is iterated on: A' u' = f' of a scaling, or A itself. */
typedef struct OstCgSystem {
    const OstBlockMatrix *matrix;        /* A */
    const OstBlockMatrix *scaled_matrix; /* S A S^T, or NULL: A */
    const OstScaling *scaling;           /* S, or NULL: the identity */
} OstCgSystem;

/* Collective. Solves A u = f from u = 0 by preconditioned conjugate gradients until ||f - A u|| <=
 * options->relative_residual ||f|| in the unscaled norm. That residual is recomputed with A at the end, and iterated on
 * from there if the recursive one had drifted. Fills the report's iterations, relative_residual and
 * condition_estimate (also on failure). Returns OST_NOT_CONVERGED with the residual reached: after max_iterations, when
 * double precision holds no more, or when r·z or p·Ap is not a positive number. */
OstStatus ost_cg_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *f, double *u,
                       const OstSolverOptions *options, OstSolveReport *report);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_PRECONDITIONER_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_PRECONDITIONER_H

#include "algebra/matrix/scaling.h"

/* Collective: z = M^-1 r, M symmetric positive definite, on scaled vectors of 3 × rows numbers. `apply` must not write
 * r. `half` is cheaper and may be unsymmetric, where there is such a one, and `brief` cheaper still; r'z > 0.
 * `factors`: M is A up to rounding. `precise`: it has been given more digits. */
typedef struct OstPreconditioner {
    void *data;
    OstStatus (*apply)(void *data, const double *r, double *z);
    OstStatus (*half)(void *data, const double *r, double *z);  /* or NULL */
    OstStatus (*brief)(void *data, const double *r, double *z); /* or NULL, as `half` */
    int factors, precise;
} OstPreconditioner;

/* The system that is iterated on: A' u' = f' with A' = S A S^T, or A u = f itself. */
typedef struct OstCgSystem {
    const OstBlockMatrix *matrix; /* A */
    const OstScaling *scaling;    /* S, or NULL: the identity */
} OstCgSystem;

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_PRECONDITIONER_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_PRECONDITIONER_H

#include "algebra/matrix/scaling.h"

/* z = M^-1 r, M symmetric positive definite, on scaled vectors of 3 × rows numbers; collective, all ranks succeed or
 * fail together. `factors`: M is A, but for rounding. `apply` must not write r. */
typedef struct OstPreconditioner {
    void *data;
    OstStatus (*apply)(void *data, const double *r, double *z);
    int factors;
} OstPreconditioner;

/* A u = f as it is iterated on: A' u' = f' of a scaling, whose products are S (A (S^T u')), or A itself. */
typedef struct OstCgSystem {
    const OstBlockMatrix *matrix; /* A */
    const OstScaling *scaling;    /* S, or NULL: the identity */
} OstCgSystem;

#endif

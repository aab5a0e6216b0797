/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_CONJUGATE_GRADIENTS_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_CONJUGATE_GRADIENTS_H

#include "orthostat/context.h"

/* The callbacks of AztecOO's conjugate gradients for A x = b; collective. Vectors hold the unknowns that this rank
 * owns.
 */
typedef struct OstAztecSystem {
    void *data;
    OstLocal unknowns; /* of this rank */
    /* y = A p */
    OstStatus (*multiply)(void *data, const double *p, double *y);
    /* Called before each step with the residual r: either z = M^-1 r, or *stop = 1 (on all ranks alike) to end. */
    OstStatus (*precondition)(void *data, const double *r, double *z, int *stop);
} OstAztecSystem;

typedef enum {
    OST_AZTEC_STOPPED,   /* by `precondition` */
    OST_AZTEC_BREAKDOWN, /* p·Ap is not positive, or negligible beside |p| |Ap| */
    OST_AZTEC_STEPS      /* after most_steps */
} OstAztecEnd;

/* Collective. Improves x, which is 0 on entry, by AZ_iterate. The iteration is ended in `precondition`, as otherwise
 * AztecOO applies the preconditioner once more after its last step. Raises OST_OUT_OF_MEMORY if there is no room for
 * AztecOO's four vectors (it would end the process), and what the callbacks raise. */
OstStatus ost_aztec_cg(OstContext *ctx, const OstAztecSystem *system, const double *b, double *x, int most_steps,
                       OstAztecEnd *end);

#endif

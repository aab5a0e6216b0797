/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_CONJUGATE_GRADIENTS_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_CONJUGATE_GRADIENTS_H

#include "orthostat/context.h"

/* What AztecOO's conjugate gradients for A x = b call back. Vectors hold the unknowns that this rank owns. All ranks
 * are in the same call at the same time. */
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
    OST_AZTEC_BREAKDOWN, /* p·Ap is not a positive number, or nothing beside |p| |Ap| */
    OST_AZTEC_STEPS      /* most_steps are done */
} OstAztecEnd;

/* Collective. Improves x (which comes as zero) by AZ_iterate. The test for the end sits in `precondition`: asked
 * anywhere else, AztecOO applies the preconditioner once more after its last step. Raises OST_OUT_OF_MEMORY where there
 * is no room for AztecOO's four vectors, as it would end the process, and what the callbacks do. */
OstStatus ost_aztec_cg(OstContext *ctx, const OstAztecSystem *system, const double *b, double *x, int most_steps,
                       OstAztecEnd *end);

#endif

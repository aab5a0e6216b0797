/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_CYCLE_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_CYCLE_H

#include "orthostat/context.h"

/* The callbacks of one level of ML's cycle. Vectors hold the unknowns that this rank owns. */
typedef struct OstMlLevel {
    void *data;
    OstLocal unknowns; /* of this rank */
    /* y = A x */
    OstStatus (*multiply)(void *data, const double *x, double *y);
    /* Improves x towards A x = b, from x = 0 if `from_zero`; on the last level it solves. */
    OstStatus (*smooth)(void *data, const double *b, double *x, int from_zero);
    /* To and from the next level: coarse = Pᵀ fine, fine = P coarse; not called on the last level. */
    OstStatus (*restrict_to)(void *data, const double *fine, double *coarse);
    OstStatus (*prolong)(void *data, const double *coarse, double *fine);
} OstMlLevel;

/* ML's multigrid cycle (ML_Cycle_MG) over levels whose operators are the caller's. The finest level is visited once;
 * every level between it and the last one is visited twice:
 *     x1 = B b,    x = x1 + 2.25 B (b - A x1),    B: one cycle on that level.
 * An error component with eigenvalue t of B A is multiplied by (1 - t)(1 - 2.25 t), which is below 1 for 0 < t < 1.44
 * (1.20 was the largest seen). So the cycle is a fixed, symmetric and positive definite operator, as conjugate
 * gradients need it, without inner products. */
typedef struct OstMlCycle OstMlCycle;

/* Collective. `level` is copied, what its entries point to stays the caller's and outlives the cycle. Raises
 * OST_LIMIT_EXCEEDED if a level has no fewer unknowns than the one before, and OST_OUT_OF_MEMORY if there is no room
 * for ML's vectors: ML would end the process in both cases. */
OstStatus ost_ml_cycle_create(OstContext *ctx, int levels, const OstMlLevel *level, OstMlCycle **cycle);
void ost_ml_cycle_destroy(OstMlCycle **cycle);

/* Collective. z = one cycle from zero for A z = r on level 0; or `half` of it, which smooths that level after the other
 * levels alone, and visits these once: it takes half the time or less, and is not symmetric, but r'z > 0 all the same.
 */
OstStatus ost_ml_cycle_apply(OstMlCycle *cycle, int half, const double *r, double *z);

#endif

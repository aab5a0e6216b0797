/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_H

#include "algebra/multigrid/coarsest.h"
#include "algebra/multigrid/levels.h"
#include "algebra/multigrid/smoother.h"

/* What a level works on; vectors have room for the ghosts of its own matrix and of the finer level's prolongator. */
typedef struct OstCycleLevel {
    const OstLevelMatrix *matrix;
    const OstProlongator *prolongator; /* to this level from the next; NULL on the coarsest */
    OstSmoother *smoother;             /* of the levels; NULL where the coarsest level is solved directly */
    double *right_side, *solution;
    double *residual;
    /* of the inner conjugate gradients; NULL on the finest level */
    double *preconditioned, *product, *direction, *direction_product;
} OstCycleLevel;

/* A multigrid cycle: V on the finest level; below it each coarse problem is solved by a few steps of flexible conjugate
 * gradients preconditioned by the next level (a K-cycle: Notay and Vassilevski 2008), the coarsest directly. */
typedef struct OstCycle {
    OstContext *ctx;
    OstMetricLevels levels;
    OstCycleLevel level[OST_MAX_LEVELS];
    OstCoarsest *coarsest; /* NULL if the coarsest level is too large for it */
    int inner_steps;       /* 2; 1 makes it a V-cycle, a fixed symmetric operator */
} OstCycle;

/* Collective. Takes over the levels (the caller's are emptied). */
OstStatus ost_cycle_create(OstContext *ctx, OstMetricLevels *levels, const OstSolverOptions *options, OstCycle **cycle);
void ost_cycle_destroy(OstCycle **cycle);

/* Collective. z = one cycle from zero for A z = r on the finest level; 3 × rows numbers each. */
OstStatus ost_cycle_apply(OstCycle *cycle, const double *r, double *z);

/* Collective. z solves A z = r roughly: a few steps of flexible conjugate gradients, as on the levels below. For cycles
 * that something finer stands on; memory for it is taken at the first call. */
OstStatus ost_cycle_solve(OstCycle *cycle, const double *r, double *z);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_H

#include "algebra/multigrid/levels.h"
#include "algebra/multigrid/quadratic.h"

/* The multigrid cycle. ML runs it (algebra/trilinos/cycle.h); matrices, prolongators and smoothers of the levels are
 * ours. The coarsest level is solved by factors. With quadratic tets, their level is the finest. */
typedef struct OstCycle OstCycle;

/* Collective. Takes over the levels and the quadratic level and empties the caller's; *quadratic is NULL for linear
 * tets. */
OstStatus ost_cycle_create(OstContext *ctx, OstLevels *levels, OstQuadraticLevel **quadratic,
                           const OstSolverOptions *options, OstCycle **cycle);
void ost_cycle_destroy(OstCycle **cycle);

/* Collective. z = one cycle from zero for A z = r on the finest level; as OstPreconditioner's `apply`, with the cycle
 * as `data`. */
OstStatus ost_cycle_apply(void *data, const double *r, double *z);

/* Collective. Half of it (algebra/trilinos/cycle.h), as OstPreconditioner's `half`. The brief half, and that of
 * quadratic tets, smooths the finest level by one step. */
OstStatus ost_cycle_apply_half(void *data, const double *r, double *z);
OstStatus ost_cycle_apply_brief(void *data, const double *r, double *z);

/* Local. Raises the degree of the smoothers' polynomials by `more`, sets the width of their interval to `ratio`, and
 * raises its upper end. */
void ost_cycle_strengthen(OstCycle *cycle, int more, double ratio);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_H

#include "algebra/multigrid/levels.h"
#include "algebra/multigrid/quadratic.h"

/* The multigrid cycle: ML runs it (algebra/trilinos/cycle.h) over levels whose matrices, prolongators and smoothers are
 * ours. The coarsest level is solved by factors. A level of quadratic tets, if there is one, is the finest. */
typedef struct OstCycle OstCycle;

/* Collective. Takes over the levels and the quadratic level (the caller's are emptied); `quadratic` points to NULL for
 * linear tets. */
OstStatus ost_cycle_create(OstContext *ctx, OstMetricLevels *levels, OstQuadraticLevel **quadratic,
                           const OstSolverOptions *options, OstCycle **cycle);
void ost_cycle_destroy(OstCycle **cycle);

/* Collective. z = one cycle from zero for A z = r on the finest level; 3 × rows numbers each. */
OstStatus ost_cycle_apply(OstCycle *cycle, const double *r, double *z);

/* Local. Smooths with polynomials of `more` degrees more, over an interval `ratio` wide, and with more care for its
 * upper end. */
void ost_cycle_strengthen(OstCycle *cycle, int more, double ratio);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_REFINE_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_REFINE_H

#include "algebra/krylov/goal.h"

/* Collective. Solves A u = r until the solver's own, recursive residual is at most goal->target, or stops early and
 * sets goal->end and goal->words (goal->end is OST_END_REACHED on entry). Counts its iterations by ost_goal_count. r
 * and u have 3 × rows numbers; u is 0 on entry and holds what was reached, also on failure. A failure means that no
 * other solver could do better. */
typedef OstStatus (*OstInnerSolve)(void *data, const double *r, double *u, OstGoal *goal);

/* Collective. Iterative refinement: `inner` solves for the recomputed residual f - A u until the goal is reached or a
 * pass gains nothing. A correction is taken if it lowers the energy or the residual; else u stays. goal->end says how
 * it ended. */
OstStatus ost_refine(const OstBlockMatrix *matrix, OstInnerSolve inner, void *data, const double *f, double *u,
                     OstGoal *goal);

#endif

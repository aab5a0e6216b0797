/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_REFINE_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_REFINE_H

#include "algebra/krylov/convergence_rate.h"
#include "algebra/matrix/block_matrix.h"
#include "orthostat/solver.h"

/* How an iterative solver's work ended. */
typedef enum {
    OST_END_REACHED,
    OST_END_SLOW,           /* it would take more than the patience there is */
    OST_END_PRECONDITIONER, /* the preconditioner is not positive definite */
    OST_END_STALLED,        /* solving for what is left gains nothing, and it is not rounding */
    OST_END_ROUNDING,       /* double precision holds no more */
    OST_END_ITERATIONS      /* the most allowed are done */
} OstEnd;

/* What a solver works towards, and how far it is; norms are of the unscaled residual. */
typedef struct OstGoal {
    OstContext *ctx;
    double start;    /* ||f|| */
    double target;   /* relative_residual × ||f|| */
    double norm;     /* ||f - A u||, recomputed */
    double limit;    /* about the least that rounding leaves of it; 0 where nobody asked */
    int compensated; /* so close to the limit that residuals are computed with compensated sums
                        (ost_compensated_residual) */
    int iterations;
    int most_iterations;
    int patience;           /* 0: endless */
    int attainable_will_do; /* less than the target, where rounding holds no more */
    double settled;         /* beyond the target, until a correction is no larger than this beside u; 0: not so */
    double drift;           /* then: how far corrections would still move u, over u, by their geometric series */
    OstConvergence pace;
    OstEnd end;
    char words[200]; /* the end, unless reached */
} OstGoal;

/* Collective. Finds u with ||r - A u|| <= goal->target by the solver's own, recursive residual, or stops early and says
 * so in goal->end and goal->words (which come as REACHED); counts its iterations by ost_goal_count. r and u have 3 ×
 * rows numbers, u comes as 0 and holds what was reached, also on failure. Failures are what no other solver could do
 * better. */
typedef OstStatus (*OstInnerSolve)(void *data, const double *r, double *u, OstGoal *goal);

/* Collective. The goal of A u = f from u = 0. Raises OST_INVALID_INPUT if f is not finite. */
OstStatus ost_goal_set(const OstBlockMatrix *matrix, const double *f, const OstSolverOptions *options, OstGoal *goal);

/* Collective. Improves u by `inner` until f - A u, as A, u and f give it, is as small as the goal: what a recursive
 * residual hid is solved for again. A correction counts if it lowers the energy or the residual, else u stays. How it
 * ended is in the goal. */
OstStatus ost_refine(const OstBlockMatrix *matrix, OstInnerSolve inner, void *data, const double *f, double *u,
                     OstGoal *goal);

/* Local. OST_SUCCESS if the goal, or what will do, was reached, else OST_NOT_CONVERGED with its words and the residual
 * reached. */
OstStatus ost_goal_verdict(const OstGoal *goal);

/* Local. About the least relative residual that double precision holds: the limit is an estimate, and what was reached
 * says better where it is less. 0 where nobody asked. */
double ost_goal_attainable(const OstGoal *goal);

/* Local. Counts an iteration from r·z = weight that left a residual of this norm, and shows how far it is on the way.
 * Returns whether to go on: not if the goal is reached, out of iterations or of patience. */
int ost_goal_count(OstGoal *goal, double norm, double weight);

/* Local. Is r·z a positive number? If not, the end is OST_END_PRECONDITIONER. */
int ost_goal_accepts(OstGoal *goal, double weight);

/* Local. Raises OST_NOT_CONVERGED: p·Ap, `energy`, is not what a positive definite stiffness makes of it. */
OstStatus ost_goal_refuse_indefinite(const OstGoal *goal, double energy);

#endif

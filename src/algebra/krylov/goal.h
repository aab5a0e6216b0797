/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_GOAL_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_GOAL_H

#include "algebra/krylov/algebraic_error.h"
#include "algebra/krylov/convergence_rate.h"
#include "algebra/matrix/block_matrix.h"
#include "orthostat/solver.h"

/* How an iterative solver ended. */
typedef enum {
    OST_END_REACHED,
    OST_END_SLOW,           /* it would need more iterations than the patience allows */
    OST_END_PRECONDITIONER, /* the preconditioner is not positive definite */
    OST_END_STALLED,        /* solving for the residual gains nothing, and rounding is not the cause */
    OST_END_ROUNDING,       /* double precision allows no smaller residual */
    OST_END_ITERATIONS      /* the maximum number of iterations is reached */
} OstEnd;

/* Ends an iteration by the error of u in the norm of the energy, |u - u*|_A, which is estimated on the way. */
typedef struct OstErrorStop {
    /* Collective. Asked once the error has come down to `first`, and then again each time it has to *next.
     * u is that reached, and `error` its error. Sets *next: one that is no smaller than `error` ends the iteration, 0
     * leaves its end to the residual. */
    OstStatus (*ask)(void *data, const double *u, double error, double *next);
    void *data;
    double first;
    int relative; /* `first` is a share of |u|_A, of a solve from u = 0 */
} OstErrorStop;

/* What a solver works towards and how close it is. Norms are 2-norms of the unscaled residual. */
typedef struct OstGoal {
    OstContext *ctx;
    double start;    /* ||f|| */
    double target;   /* relative_residual × ||f|| */
    double norm;     /* ||f - A u||, recomputed */
    double limit;    /* estimate of the smallest norm that rounding allows; 0 if not computed */
    int compensated; /* norm is so close to the limit that residuals are computed by ost_compensated_residual */
    int iterations;
    int most_iterations;
    int patience;          /* iterations the solver may still need; 0: no limit */
    int crude;             /* the error of u is not estimated, and u need not settle */
    int accept_attainable; /* a norm at the rounding limit is accepted even above the target */
    double settled; /* also iterate until a correction changes u by no more than this, relative to u; 0: do not */
    double drift; /* with `settled`: estimated relative change of u by all later corrections (their geometric series) */
    double smallest; /* eigenvalue of M^-1 A, about, as the last strategy's iterations show it; 0 if not known */
    double scale;    /* of a mixed form's preconditioner of A (saddle/error.h); at first: what is known of it, or 0 */
    OstConvergence convergence;
    const OstErrorStop *stop; /* ends the iteration before the target is reached; NULL: none */
    double next;              /* the error at which it is asked next; 0: not asked yet */
    int enough;               /* it has ended the iteration */
    OstAlgebraicError error;  /* of u in the norm of the energy; 0 where it is not known */
    int stagnates;            /* the pass at hand gains nothing: what comes next begins from a true residual */
    double rate;              /* by which an iteration multiplies it */
    int indefinite;           /* p·Ap < 0 was found */
    OstEnd end;
    char words[200]; /* why it ended, unless OST_END_REACHED */
    int singular;    /* has a strategy found the stiffness singular to rounding? */
} OstGoal;

/* Collective. The goal of A u = f from u = 0. Raises OST_INVALID_INPUT if f is not finite. */
OstStatus ost_goal_set(const OstBlockMatrix *matrix, const double *f, const OstSolverOptions *options, OstGoal *goal);

/* Local. Before the first iteration from a true residual. */
void ost_goal_begin_pass(OstGoal *goal);

/* Local. Counts an iteration with r·z = weight whose residual has this norm, and shows the progress. Returns whether to
 * go on: not if the target is reached, the pass stagnates, or the iterations or the patience are used up. */
int ost_goal_count(OstGoal *goal, double norm, double weight);

/* Local. Is the residual at the rounding limit? That is an estimate: one a few times larger may still be all rounding.
 */
int ost_goal_at_limit(const OstGoal *goal);

/* Local. The target was missed, though the iteration may have ended with OST_END_REACHED: ends with the reason, once
 * goal->limit is known. `stall` is what hides further gains, or empty. */
void ost_goal_explain_end(OstGoal *goal, const char *stall);

/* Local. Returns whether r·z is positive and finite; if not, ends with OST_END_PRECONDITIONER. */
int ost_goal_accepts(OstGoal *goal, double weight);

/* Local. Raises OST_NOT_CONVERGED: p·Ap = `energy` shows that the stiffness is not positive definite. */
OstStatus ost_goal_refuse_indefinite(OstGoal *goal, double energy);

/* Local. The iterations that the stop saves: as many more would reach the target, at the present rate. */
int ost_goal_saved(const OstGoal *goal);

/* Local. The error at which the stop is asked next. */
double ost_goal_next(const OstGoal *goal);

/* Local. Estimate of the smallest relative residual that double precision allows: the limit, or the residual reached
 * where that is smaller. 0 if the limit was not computed. */
double ost_goal_attainable(const OstGoal *goal);

/* Local. OST_SUCCESS if the target, or an accepted rounding limit, was reached; else OST_NOT_CONVERGED with the reason
 * and the residual reached. */
OstStatus ost_goal_verdict(const OstGoal *goal);

#endif

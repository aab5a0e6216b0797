/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_STRATEGY_H
#define ORTHOSTAT_SOLVE_STRATEGY_H

#include "accuracy/estimate.h"
#include "core/together/together.h"
#include "guard/guard.h"
#include "orthostat/analysis.h"
#include "problem/problem.h"
#include "solve/reactions/reactions.h"

/* A way to solve a problem. A new one is a new file, and a line in analysis.c that picks it. Each function is
 * collective and works on analysis->work, which the strategy allocates. */
typedef struct OstStrategy {
    /* Makes what all solves share, unless it is there, and what this load needs; adds objections to `before`. */
    OstStatus (*prepare)(OstAnalysis *analysis, OstVerdict *before);

    /* Fills result->displacement, result->solve, result->reached, and the sizes that errors are relative to. */
    OstStatus (*solve)(OstAnalysis *analysis, OstResult *result, OstSolvedFor *solved_for);

    /* Frees the work space. */
    void (*release)(OstAnalysis *analysis);
} OstStrategy;

/* A right-hand side that is a sum of others, each times a factor, which have been solved for. */
typedef struct OstLoadSum {
    int count;
    double factor[OST_MOST_TOGETHER];
    const OstAnalysis *of[OST_MOST_TOGETHER];
    const OstResult *result[OST_MOST_TOGETHER];
} OstLoadSum;

struct OstAnalysis {
    OstContext *ctx;
    OstProblem *problem;
    OstSolverOptions options;
    const OstStrategy *strategy;
    void *work;             /* the strategy's; NULL until prepared */
    OstEstimate *estimate;  /* of the discretisation error; kept where the analysis serves several loads, else NULL */
    OstReactions reactions; /* adjoint problems of watched ones, likewise */
    double cut_off;         /* of the mesh, as OstAnswerError has it; NAN: not found yet */
    int serves_several;     /* loads are to follow, so that what they share is kept */
    int leaves_reactions;   /* watched ones have no error until ost_analysis_find_reactions is called */
    OstAnalysis *company;   /* the one whose solver this shares with others that run beside it; linear theory alone will
                               do. NULL: it is alone */
    const OstLoadSum *sum;  /* linear theory: what the load is a sum of; or NULL */
    const double *start;    /* a displacement (3 × node_count) near that of the linear problem, or NULL */
    const double *pose;     /* likewise, near that of large rotations */
};

extern const OstStrategy ost_linear_strategy;    /* linear.c */
extern const OstStrategy ost_nonlinear_strategy; /* nonlinear.c */

/* Collective. How far is linear theory off in this linear result? Fills that part of result->newton. */
OstStatus ost_nonlinear_judge(const OstProblem *problem, OstResult *result);

/* Collective. The buckling modes of a linear result that the problem asks for, if any. */
OstStatus ost_analysis_find_buckling(const OstAnalysis *analysis, OstResult *result);

/* Collective. ost_left_out_find and ost_buckling_judge, on the account of large rotations. */
OstStatus ost_nonlinear_look_closer(const OstAnalysis *analysis, OstResult *result);

/* Local. Is linear theory, off by so much, the answer, as `auto` allows? */
int ost_nonlinear_stays_linear(const OstProblem *problem, double linear_error);

/* Local. Has Newton's method a mixed form for the problem, should it be needed? Not without an energy. */
int ost_nonlinear_may_be_mixed(const OstProblem *problem);

/* Collective. A result with room for the displacement. */
OstStatus ost_result_create(const OstProblem *problem, OstResult **result);

/* Collective. Another loading has been given to the problem (problem/cases/load_case.h). */
OstStatus ost_analysis_take_loading(OstAnalysis *analysis);

/* Collective. Makes all that solves share: stiffness, solver and, where that is asked for, the estimate. */
OstStatus ost_analysis_make_common(OstAnalysis *analysis, unsigned fields);

/* Collective. Makes all that the next solve needs; all objections are raised as one failure. */
OstStatus ost_analysis_prepare(OstAnalysis *analysis);

/* Collective. Completes a result whose displacement at t is there, `solved` with that status: load, reactions, checks,
 * and the fields asked for. Raises what ost_analysis_solve does. */
OstStatus ost_analysis_conclude(const OstAnalysis *analysis, double t, OstStatus solved, const OstSolvedFor *solved_for,
                                unsigned fields, OstResult *result);

/* Collective. Estimates the error that the mesh makes in a result whose displacement at t is there, while the solver of
 * its stiffness lives. OST_EFFECT_ERROR_ESTIMATE. */
OstStatus ost_analysis_estimate(OstAnalysis *analysis, double t, OstResult *result);

/* Collective. What is to be added to watched reactions, and their errors, of a result of the last solve whose estimate
 * has left them. OST_EFFECT_ERROR_ESTIMATE. */
OstStatus ost_analysis_find_reactions(OstAnalysis *analysis, OstResult *result);

/* Collective. Makes room for what the estimate says of tets and, where the case watches something, of nodes. */
OstStatus ost_result_allow_error(const OstProblem *problem, OstResult *result);

/* Local. That room. */
OstSurplus ost_result_surplus(const OstResult *result);

/* Local. Marks a result that the solver left unfinished, with its words. */
void ost_result_take_outcome(OstResult *result, OstStatus solved);

/* Collective. Copies the problem's load at t, and makes room for the reactions. */
OstStatus ost_result_take_load(OstResult *result, const OstProblem *problem, double t);

/* Collective. Finds where the displacement is largest. */
OstStatus ost_result_find_largest(OstResult *result);

#endif

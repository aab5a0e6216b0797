/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_DATA_H
#define ORTHOSTAT_ALGEBRA_SOLVER_DATA_H

#include "algebra/direct/direct.h"
#include "algebra/direct/mumps.h"
#include "algebra/matrix/geometry.h"
#include "algebra/multigrid/metric.h"
#include "algebra/solver_aim.h"
#include "algebra/trilinos/epetra.h"
#include "algebra/trilinos/smoothed_aggregation.h"

struct OstSolver {
    OstContext *ctx;
    const OstBlockMatrix *matrix;
    OstSolverGeometry geometry;
    OstSolverOptions options; /* the user's */
    OstSolverAim aim;
    const OstSaddle *saddle; /* of the mixed form that is being solved, or NULL */
    int aged;                /* have the matrix's values changed since the current strategy was built? */
    int is_shared;           /* are strategy and map another solver's? */
    int precise;             /* has single precision been found too little for the coarse levels? */
    int fine;                /* is the current strategy the last one: patches? */
    unsigned broken;         /* a bit for each method whose preconditioner was last found not to be positive definite */
    int over_linear;         /* were the linear tets a level of METRIC, when it was last tried? */
    int repeated;            /* is it a stiffness among many? */
    OstMumpsForecast factors; /* what factors of the matrix would take, once METRIC has failed */
    int fits;                 /* and does memory allow them? */
    int singular;             /* has a strategy found its factors, and so the stiffness, singular to rounding? */
    OstSolverPlan plan;
    /* the current strategy: */
    OstMethod method;              /* AUTO if there is none */
    OstSmoothedAggregation *plain; /* one of these three is set up */
    OstMetric *metric;
    OstDirect *direct;
    OstSaddleFactors *whole; /* beside `direct`, of a mixed form's both equations; NULL if there are none */
    OstEpetraMap *map;
    double nonzeros;         /* of the matrix, over all ranks */
    double smallest;         /* eigenvalue of the last solve's preconditioned matrix; 0 if not known */
    double scale;            /* of a mixed form's preconditioner, as its last solve has found it (saddle/error.h) */
    double setup_seconds;    /* for all strategies so far */
    double strategy_seconds; /* setup of the current one, until it is added to a step */
    int steps;               /* strategies that could not be built before the current one */
    OstSolveStep step[OST_MAX_STEPS];
};

/* Local. What the current strategy iterates on, and its preconditioner. */
void ost_solver_system(const OstSolver *solver, OstCgSystem *system, OstPreconditioner *preconditioner);

/* Local. Has the current strategy one? Factors of both equations of a mixed form alone are none of A. */
int ost_solver_has_preconditioner(const OstSolver *solver);

/* Collective. Sets up solver->direct. Where A cannot be factored, as it is indefinite, but both equations of the aim's
 * mixed form can, and the second holds what A does not, solver->whole takes its place. */
OstStatus ost_solver_factor_direct(OstSolver *solver, double memory);

/* Collective. Improves u and the pressures of solver->saddle by the current strategy, as ost_saddle_solve. */
OstStatus ost_solver_improve_mixed(OstSolver *solver, const double *f, double *u, OstGoal *goal,
                                   OstSolveReport *report);

/* Collective. The method that follows the current one: DIRECT after METRIC where factors are foretold to take less than
 * it takes to find out about STRONG. */
OstStatus ost_solver_next(OstSolver *solver, OstMethod *next);

/* Local. The options of the strategy for `method`, from the planned ones and what has been found out since. Where
 * factors of the matrix itself fit, those of TWO_LEVEL's coarse level may take less than they do. */
void ost_solver_learned_options(const OstSolver *solver, OstMethod method, OstSolverOptions *options);

/* Local. `status` of a strategy's set-up with these options; raised again with the reason if it broke that rule. */
OstStatus ost_solver_explain_memory(const OstSolver *solver, const OstSolverOptions *options, OstStatus status);

/* Local. The method to go on with where no next one can be built: that which has converged fastest, for what an
 * iteration costs; AUTO if none has come so far. */
OstMethod ost_solver_fastest(const OstSolver *solver, const OstSolveReport *report);

/* Local. The same, but STRONG over patches (solver->fine) comes before METRIC and STRONG. */
OstMethod ost_solver_choose_last(OstSolver *solver, const OstSolveReport *report);

/* Local. Says that no other strategy is left, and what this one costs. */
void ost_solver_tell_last(const OstSolver *solver, const OstGoal *goal, const OstSolveReport *report);

#endif

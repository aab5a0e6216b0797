/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_DATA_H
#define ORTHOSTAT_ALGEBRA_SOLVER_DATA_H

#include "algebra/direct/direct.h"
#include "algebra/multigrid/metric.h"
#include "algebra/solver.h"
#include "algebra/solver_plan.h"
#include "algebra/trilinos/epetra.h"
#include "algebra/trilinos/smoothed_aggregation.h"

/* Only solver_run.c and solver_uses.c read it. */
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
    OstSolverPlan plan;
    /* the current strategy: */
    OstMethod method;              /* AUTO if there is none */
    OstSmoothedAggregation *plain; /* one of these three is set up */
    OstMetric *metric;
    OstDirect *direct;
    OstEpetraMap *map;
    double nonzeros;         /* of the matrix, over all ranks */
    double smallest;         /* eigenvalue of the last solve's preconditioned matrix; 0 if not known */
    double setup_seconds;    /* for all strategies so far */
    double strategy_seconds; /* setup of the current one, until it is added to a step */
    int steps;               /* strategies that could not be built before the current one */
    OstSolveStep step[OST_MAX_STEPS];
};

/* Local. The system that the current strategy iterates on, and its preconditioner. */
void ost_solver_system(const OstSolver *solver, OstCgSystem *system, OstPreconditioner *preconditioner);

#endif

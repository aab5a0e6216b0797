/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_SUPERPOSITION_H
#define ORTHOSTAT_SOLVE_SUPERPOSITION_H

#include "solve/strategy.h"

/* The linear answers of a path: what each function of time (problem/problem.h) causes at factor 1, to be added up. */
typedef struct OstSuperposition {
    int count;            /* functions; 0: not solved yet */
    double **part;        /* the displacement of each, and the pressures of a mixed form: ost_newton_state_size */
    double *norm;         /* of each right-hand side */
    OstSolveReport solve; /* of all: iterations are added up, of errors the largest counts */
} OstSuperposition;

/* Collective. Room for the parts of a problem's functions. */
OstStatus ost_superposition_make_room(const OstProblem *problem, OstSuperposition *all);

/* Collective, on a prepared linear analysis. One solve for each function. Raises OST_INVALID_INPUT for loads that
 * cannot be solved for, OST_NOT_CONVERGED where the solver stopped early; all parts are there then. */
OstStatus ost_superposition_create(OstAnalysis *analysis, OstSuperposition *all);
void ost_superposition_release(OstSuperposition *all);

/* Collective. The answer at t. Errors are relative to the sum of what the functions' loads are in size. */
OstStatus ost_superposition_at(const OstSuperposition *all, const OstAnalysis *analysis, double t, OstResult *result,
                               OstSolvedFor *solved_for);

#endif

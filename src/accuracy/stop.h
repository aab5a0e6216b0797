/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_STOP_H
#define ORTHOSTAT_ACCURACY_STOP_H

#include "accuracy/estimate.h"

/* Ends a linear solve where the error of its equations is a small share of the discretisation error, both in the norm
 * of the energy: more iterations would hardly make the answer better. The discretisation error is estimated on the way,
 * once that of the equations is a hundredth of the solution, and again while the two are of one size. */
typedef struct OstSolveStop {
    OstErrorStop stop; /* for OstSolverAim */
    const OstProblem *problem;
    OstSolver *solver;
    OstEstimate *estimate;
    OstEstimate *own;       /* the same where it was made here; else NULL */
    double share;           /* of the discretisation error */
    double *displacement;   /* 3 × node_count */
    OstSurplus surplus;     /* of the last estimate; the caller's */
    OstAnswerError *answer; /* the last estimate; the caller's */
    double error;           /* of the equations, there */
    int settled;            /* the discretisation error is known */
} OstSolveStop;

/* Collective. For solves at t = 1; `estimate` is one for the problem, or NULL; what `surplus` names and `answer`
 * are filled by the solve. The stop does not move. */
OstStatus ost_solve_stop_open(const OstProblem *problem, OstSolver *solver, double share, OstEstimate *estimate,
                              const OstSurplus *surplus, OstAnswerError *answer, OstSolveStop *stop);
void ost_solve_stop_close(OstSolveStop *stop);

/* Local. The share of the discretisation error that the equations may leave: `share`, or less where the case asks for
 * the error of a displacement. */
double ost_stop_share(const OstProblem *problem, double share, const OstAnswerError *answer);

/* Local. The next solve goes on from where one was stopped, to this error, and looks at the discretisation's again. */
void ost_solve_stop_tighten(OstSolveStop *stop, double error);

#endif

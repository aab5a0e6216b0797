/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_LINEAR_H
#define ORTHOSTAT_SOLVE_LINEAR_H

#include "solve/stiffness_solver.h"
#include "solve/strategy.h"

/* The work space of a linear solve, which nonlinear strategies begin with: K v = P (f - K g), u = v + g. Stiffness and
 * solver are made once, for all loads. */
typedef struct OstLinear {
    OstStiffnessSolver stiffness; /* its solver is made by the first solve */
    double *rhs, *v;              /* 3 × rows */
    double *volume, *pressure;    /* of a mixed form: right-hand side and pressures, ghosts included; else NULL */
    int enclosed;                 /* is only the shape of the pressure known (ost_guard_volume)? */
    int has_rhs;                  /* of the load at hand */
    double rigid_motion;
} OstLinear;

/* Solves with one function of time at a time (problem/problem.h), on a prepared linear analysis. */

/* Collective. Takes the function's load for the next solve, and checks it. */
OstStatus ost_linear_load(OstAnalysis *analysis, int function, OstVerdict *before);

/* Collective. Solves for the load taken, and for what moves distributing couplings: the displacement (3 × node_count)
 * at factor 1, and behind it the pressures of a mixed form; the norm of the right-hand side. OST_NOT_CONVERGED: that
 * where the solver stopped. */
OstStatus ost_linear_solve(OstAnalysis *analysis, int function, OstSolveReport *report, double *norm,
                           double *displacement);

/* Collective. The work of the right-hand side at t on the unknowns of a displacement. */
OstStatus ost_linear_work(const OstAnalysis *analysis, double t, const double *displacement, double *work);

/* Local. The stop goes by the norm of the energy. Another norm may see more: of a soft part beside a stiff one that has
 * the energy, of reactions, of rounding. By how much the equations' errors exceed what is good enough beside the
 * answer's; INFINITY: nobody knows. */
double ost_stop_excess(const OstErrors *errors, const OstAnswerError *answer, int watches_stress);

#endif

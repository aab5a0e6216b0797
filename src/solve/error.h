/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_ERROR_H
#define ORTHOSTAT_SOLVE_ERROR_H

#include "algebra/solver.h"
#include "guard/guard.h"

/* Errors below small_error need not be known better than one application of the preconditioner tells. Those of forces
 * are stated times forces_caution: the error is found to a part of its energy, of which they may hold more than the
 * displacement (docs/checks.md). Errors by rounding are corrected above worth_correcting, but not where they move the
 * displacement by more than past_correcting: the rounded stiffness then tells too little of the tets' softest modes.
 * Above large_residual rounding is not the reason of an error, but the residual asked for. */
extern const double ost_small_error, ost_forces_caution, ost_worth_correcting, ost_past_correcting, ost_large_residual;

/* Collective, after ost_solver_solve and while its stiffness lives. The errors of a displacement in the problem's
 * equations at t = 1: the solver finds what the residual f - K u leaves, with K u summed tet by tet. That takes
 * differences of displacements between the nodes of a tet, so it is far more exact than the rounded entries of the
 * stiffness: what rounding these has cost is found too.
 *
 * Where rounding, not the residual asked for, is the reason of an error above 1e-4, the displacement is corrected by
 * conjugate gradients for the tets' equations, preconditioned by the solver, until errors are below
 * 1e-6 or that gains nothing more.
 *
 * errors->known: 0 where the solver cannot tell. Takes one application of the preconditioner where all errors come out
 * below 1e-6, and some more steps elsewhere. `enough` > 0: no more than the one application, and no correction; but a
 * few steps where the error itself is wanted (solved->error) and that of the displacement is above that. */
typedef struct OstSolved {
    const OstSolveReport *report;
    const double *rhs;    /* 3 × rows */
    double *unknowns;     /* 3 × rows; corrected, as is the displacement */
    double *displacement; /* 3 × node_count, ghosts included */
    double *pressure;     /* of a mixed form; pressures->count, ghosts included; and of the tets' vertices, which */
    double *of_tets;      /* the problem's field has */
    double **internal; /* becomes the internal forces of the displacement, 3 × owned_nodes, where they were summed */
    double *error;     /* becomes the error found, 3 × node_count, ghosts included; or NULL */
} OstSolved;
OstStatus ost_find_errors(const OstProblem *problem, OstSolver *solver, const OstSolved *solved, double enough,
                          OstErrors *errors);

/* Collective. The same of a state of Newton's method where rotations are large, by the stiffness of the last
 * correction, and without any correction. Not of a mixed form. */
typedef struct OstTurned {
    double t;
    const double *displacement;    /* 3 × node_count, ghosts included */
    const double *internal, *load; /* 3 × owned_nodes: forces there */
    const double *residual;        /* 3 × rows */
} OstTurned;
OstStatus ost_find_turned_errors(const OstProblem *problem, OstSolver *solver, const OstTurned *turned,
                                 OstErrors *errors);

/* Collective. The same of a mixed form, of both equations; the problem is at the answer's pressure. */
OstStatus ost_find_mixed_errors(const OstProblem *problem, OstSolver *solver, const OstSolved *solved, double enough,
                                OstErrors *errors);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_NEWTON_H
#define ORTHOSTAT_SOLVE_NEWTON_H

#include "guard/guard.h"
#include "solve/stiffness_solver.h"

/* Newton's method for a nonlinear problem: minimises the total energy E(u) - load(t)·u over what the supports leave
 * free, in load steps that adapt themselves. */
typedef struct OstNewton OstNewton;

/* A state at rest, and all that the next load step depends on besides the problem: from a copy of it the path goes on
 * the same way, bit for bit on the same ranks. */
typedef struct OstNewtonState {
    double t;             /* load factor (pseudo-time) */
    double *displacement; /* 3 × node_count, ghosts filled; a mixed form's pressures follow, ghosts filled too */
    double *slope;        /* as many: its change per t over the last load step; zero if there was none */
    double step;          /* load step to try next; 0: not known */
} OstNewtonState;

/* Local. How many numbers the displacement of a state has, those of pressures included. */
size_t ost_newton_state_size(const OstProblem *problem);

/* Local. The state at t = 0 without load; its arrays. */
OstStatus ost_newton_state_create(const OstProblem *problem, OstNewtonState *state);
void ost_newton_state_release(OstNewtonState *state);

/* Local. The part of a load to begin with, where a tangent to all of it turns the body by this angle at most. */
double ost_newton_first_step(double rotation);

/* Collective. Newton's method on a problem that is not linear (any more), with the solver that `stiffness` has at
 * u = 0; both outlive it. `solve` are the reports of the linear solve that was made there. */
OstStatus ost_newton_create(OstStiffnessSolver *stiffness, const OstSolveReport *solve, OstNewton **newton);
void ost_newton_destroy(OstNewton **newton);

/* Local. Ends the search for each state at rest where a correction is no more than this fraction of the answer's error,
 * as linear theory has it, in the norm of the energy: the next one, all that is missing, is then far smaller. At the
 * end of an advance, errors of displacements, reactions and stresses are to be small as well (ost_stop_excess), or the
 * search goes on. Without it the residual alone ends a search. */
void ost_newton_stop_at(OstNewton *newton, double fraction, const OstAnswerError *answer, int watches_stress);

/* Local. The first prediction goes straight on, to a pose that is known. */
void ost_newton_go_straight(OstNewton *newton);

/* Collective. Takes a state on to load factor `to` > state->t, in as many load steps as it needs. What is done depends
 * on the state alone and not on what was done before: away from u = 0 every call begins with a new hierarchy. Returns
 * OST_NOT_CONVERGED with the reason, the place and the load factor reached where the load cannot be followed; the state
 * is then the last one at rest. */
OstStatus ost_newton_advance(OstNewton *newton, double to, OstNewtonState *state);

/* Collective. ost_newton_advance; where it fails and linear theory has an odd strain, it asks for the units. */
OstStatus ost_nonlinear_advance(OstNewton *newton, double linear_strain, double to, OstNewtonState *state);

/* Collective. Copies the state's displacement into a result, with the reports, the residual and the sizes that
 * ost_guard_after needs. */
OstStatus ost_newton_fill(OstNewton *newton, const OstNewtonState *state, OstResult *result, OstSolvedFor *solved_for);

#endif

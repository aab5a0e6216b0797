/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_DISTRIBUTING_DISTRIBUTING_H
#define ORTHOSTAT_SOLVE_DISTRIBUTING_DISTRIBUTING_H

#include "algebra/solver.h"
#include "problem/problem.h"

/* Distributing couplings whose point is moved: the force and moment there, spread over the face as such loads are, are
 * sought for which the face's mean motion is the one given. With B the forces of a unit of each and g the motions
 * given, B' u = g: the mean displacement and rotation are those that the unit forces work on. By linear theory u = u0 +
 * K^-1 B x, u0 that of all other loads; so (B' K^-1 B) x = g - B' u0, a solve for each component given. */

/* Local. Has the problem such a coupling? */
int ost_distributing_any(const OstProblem *problem);

/* Collective. Finds the forces of all of them in one function of time, where those with another table stay in place,
 * and adds them to its load. `rhs` and, of a mixed form, `volume` (else NULL): the right-hand sides of its other loads.
 * Raises OST_INVALID_INPUT where two couplings contradict each other or a support. */
OstStatus ost_distributing_find(OstProblem *problem, OstSolver *solver, int function, const double *rhs,
                                const double *volume);

/* Unit forces of all that is given, and the responses to them; the caller's. */
typedef struct OstResponses {
    int count;
    size_t rows, pressures;   /* numbers of one; 0 pressures without a mixed form */
    double *force, *response; /* count × rows */
    double *pressure;         /* count × pressures: those of the responses, ghosts too; or NULL */
    double *products;         /* count × count: forces times responses */
} OstResponses;

/* Collective. By a solve for each. */
OstStatus ost_distributing_respond(const OstProblem *problem, OstSolver *solver, OstResponses *responses);
void ost_responses_release(OstResponses *responses);

/* Local. Room for the forces of all functions, as part of the problem's load. */
OstStatus ost_distributing_make_room(OstProblem *problem);

/* Local. Takes the forces of an earlier solve off the load. */
void ost_distributing_forget(OstProblem *problem);

/* Collective. Counts these forces as reactions of a result at t, not as its load. */
OstStatus ost_distributing_react(const OstProblem *problem, double t, OstResult *result);

#endif

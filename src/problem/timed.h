/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_TIMED_H
#define ORTHOSTAT_PROBLEM_TIMED_H

#include "problem/problem.h"

/* What acts on a body is a sum over functions of time, each a factor times a load and prescribed displacements.
 * Function 0 is t itself: the problem's force and supports. The others follow the problem's time tables. */

/* Local. How many functions there are, and the factor of one at t. */
int ost_problem_functions(const OstProblem *problem);
double ost_problem_factor(const OstProblem *problem, int function, double t);

/* Local. Adds factor × the load of one function to `force` (3 × owned_nodes), with pressures on the surface as u has
 * moved it (NULL: undeformed). */
void ost_problem_add_load(const OstProblem *problem, int function, double factor, const double *u, double *force);

/* Local. factor × this rank's part of the work function of that load (ost_problem_load_work). */
double ost_problem_work(const OstProblem *problem, int function, double factor, const double *u);

/* Local. Its right-hand side P (f - K g), with the eigenstrain's of function 0, of a linear problem, after
 * ost_problem_stiffness; 3 × rows numbers. */
OstStatus ost_problem_function_right_hand_side(const OstProblem *problem, int function, double *rhs);

/* Collective. Its displacement P v + g of every local node. */
OstStatus ost_problem_function_displacement(const OstProblem *problem, int function, const double *v, double *u);

/* Local. Does some function prescribe a displacement other than zero for an owned node? */
int ost_problem_moves(const OstProblem *problem, OstLocal node);

/* Local. Is every factor 0 at t = 0, so that a path begins there, with a body at rest? Else it begins at t = -1. */
int ost_problem_begins_at_rest(const OstProblem *problem);

/* Collective. Adds a function that follows this table (which is copied), without load and supports as yet. */
OstStatus ost_problem_add_timed(OstProblem *problem, const OstTimeTable *table);
void ost_problem_release_timed(OstProblem *problem);

#endif

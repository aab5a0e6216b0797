/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_DISTRIBUTING_HELD_H
#define ORTHOSTAT_SOLVE_DISTRIBUTING_HELD_H

#include "algebra/solver.h"
#include "problem/problem.h"

/* What moved couplings hold of motions v beside a linear answer: B'v = 0, and the energy has what their forces do as
 * the selection turns, -½ (Y v)' h_z (Y v) (turned.h) at the undeformed body. With D = K^-1 B motions are projected by
 * I - D (B'D)^-1 B', and forces by its transpose. */
typedef struct OstHeldMotions OstHeldMotions;

/* Collective. Of the answer at t, by a solve for each given component. NULL where nothing is moved; *known: 0 where no
 * rotation of a selection is known, as of one on a line. */
OstStatus ost_held_motions_create(const OstProblem *problem, OstSolver *solver, double t, int *known,
                                  OstHeldMotions **held);
void ost_held_motions_destroy(OstHeldMotions **held);

/* Collective. Projects a motion of the rows, and its pressures (or NULL); forces on the rows. */
OstStatus ost_held_motions_project(const OstHeldMotions *held, double *v, double *pressure);
OstStatus ost_held_motions_project_force(const OstHeldMotions *held, double *force);

/* Collective. Subtracts Y'h_z Y v from forces on owned nodes; v has 3 × node_count. */
OstStatus ost_held_motions_bend(const OstHeldMotions *held, const double *v, double *force);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_SECONDS_H
#define ORTHOSTAT_ALGEBRA_SOLVER_SECONDS_H

#include "orthostat/solver.h"

/* Local. Do quadratic tets of METRIC go over vertices that turn, as edges cross the stiff directions? */
int ost_solver_is_over_vertices(const OstSolverFacts *facts);

/* Local. Unknowns of the level of those vertices. */
double ost_solver_vertex_unknowns(const OstSolverFacts *facts);

/* Local. Seconds that quadratic tets take, setup and solve, by a factorisation, by multigrid, and over the vertices'
 * level, factored (infinite where that is not planned): rates of the machine on which docs/performance.md was made, of
 * which only the ratios matter. `facts` must have the thickness. */
double ost_solver_factor_seconds(const OstSolverFacts *facts);
double ost_solver_multigrid_seconds(const OstSolverFacts *facts);
double ost_solver_two_level_seconds(const OstSolverFacts *facts);

/* Local. Is Newton's method to correct quadratic tets by factors? Of other tets and where nothing is known: no. */
int ost_solver_factors_spare_corrections(const OstSolverFacts *facts);

#endif

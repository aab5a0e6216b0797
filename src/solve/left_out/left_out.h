/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_LEFT_OUT_LEFT_OUT_H
#define ORTHOSTAT_SOLVE_LEFT_OUT_LEFT_OUT_H

#include "algebra/solver.h"
#include "problem/problem.h"
#include "problem/result_data.h"

/* Collective. By how much what linear theory leaves out changes a linear answer at result->t, to first order: one
 * correction by the stiffness of the linear problem, of what is out of balance once the body has turned, to a quarter
 * of its size. Sees a column that bends under its load though nearly all energy is that of its compression. Fills
 * result->newton.linear_change, and raises linear_error to it; where something is watched and that is no more than
 * allowed, left_out too. Does nothing where the body goes where its loads push it, and nothing else is watched: its
 * energy has told all. */
OstStatus ost_left_out_find(const OstProblem *problem, OstSolver *solver, OstResult *result);

#endif

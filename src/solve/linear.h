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
    double rigid_motion;
} OstLinear;

#endif

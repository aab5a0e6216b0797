/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_PLAN_H
#define ORTHOSTAT_ALGEBRA_SOLVER_PLAN_H

#include "orthostat/solver.h"

/* Local. Memory that factoring a body's stiffness takes, as a rule of thumb; MUMPS's analysis knows better. */
double ost_solver_factor_bytes(OstGlobal unknowns);

#endif

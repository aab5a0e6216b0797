/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_EXACT_H
#define HARD_GRID_EXACT_H

#include "hard_grid/direct.h"
#include "hard_grid/grid.h"
#include "problem/result_data.h"

/* The equations as the tets have them, never rounded into a matrix: strains, stresses and forces in long double (64
 * bits on x86), from the same coordinates and elastic constants as the program's. The program's own errors are relative
 * to their solution. */

/* Collective. Solves the tets' equations from the result's displacement on, by conjugate gradients preconditioned by
 * the rounded stiffness, and compares. */
OstStatus hard_find_exact(const OstScene *scene, HardDirect *direct, const OstResult *result, HardErrors *errors);

/* Collective. The residual of the result's displacement in the tets' equations, over the loads. */
OstStatus hard_find_exact_residual(const OstScene *scene, HardDirect *direct, const OstResult *result,
                                   double *relative);

#endif

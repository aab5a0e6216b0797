/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_MIXED_EXACT_H
#define HARD_GRID_MIXED_EXACT_H

#include "algebra/saddle/factors.h"
#include "assembly/pressure/pressure_space.h"
#include "hard_grid/direct.h"
#include "hard_grid/grid.h"
#include "problem/result_data.h"

/* A mixed form's equations, assembled again, and their factors. */
typedef struct HardMixed {
    HardDirect *direct; /* without its own factors */
    const OstPressureSpace *space;
    const OstCoupling *coupling;
    const OstSaddleFactors *factors;
} HardMixed;

/* Collective. Solves both equations as the tets have them (exact.h), from the result on, by corrections with the
 * factors of the rounded ones, and compares. */
OstStatus hard_find_mixed_exact(const OstScene *scene, const HardMixed *mixed, const OstResult *result,
                                HardErrors *errors);

/* Collective. The residual of both equations as the tets have them, in forces, over the loads; without factors. */
OstStatus hard_find_mixed_exact_residual(const OstScene *scene, const HardMixed *mixed, const OstResult *result,
                                         double *relative);

#endif

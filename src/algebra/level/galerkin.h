/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_GALERKIN_H
#define ORTHOSTAT_ALGEBRA_LEVEL_GALERKIN_H

#include "algebra/level/double_matrix.h"
#include "algebra/level/prolongator.h"
#include "algebra/level/smoother_blocks.h"

/* Collective. Pᵀ A P, of the prolongator as it is kept, in single precision, but summed in double precision: positive
 * semidefinite to rounding. The rows of a block, of those that smoothed P, have the same columns: their product is
 * summed as one. `first_coarse` is the global number of this rank's first coarse node. */
OstStatus ost_galerkin_create(const OstDoubleMatrix *matrix, const OstSmootherBlocks *blocks,
                              const OstProlongator *prolongator, OstGlobal first_coarse, OstDoubleMatrix **coarse);

#endif

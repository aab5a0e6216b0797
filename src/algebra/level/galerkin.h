/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_GALERKIN_H
#define ORTHOSTAT_ALGEBRA_LEVEL_GALERKIN_H

#include "algebra/level/double_matrix.h"
#include "algebra/level/prolongator.h"
#include "algebra/level/smoother_blocks.h"

/* Collective. The Galerkin product Pᵀ A P, summed in double precision with the single-precision P, so that it is
 * positive semidefinite to rounding. All rows of P in one smoother block have the same columns, so the product is
 * formed block by block. `first_coarse` is the global number of this rank's first coarse node. */
OstStatus ost_galerkin_create(const OstDoubleMatrix *matrix, const OstSmootherBlocks *blocks,
                              const OstProlongator *prolongator, OstGlobal first_coarse, OstDoubleMatrix **coarse);

#endif

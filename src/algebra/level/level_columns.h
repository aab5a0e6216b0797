/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_LEVEL_COLUMNS_H
#define ORTHOSTAT_ALGEBRA_LEVEL_LEVEL_COLUMNS_H

#include "algebra/level/prolongator.h"
#include "algebra/level/smoother_blocks.h"
#include "algebra/matrix/columns.h"

/* What a level does with one vector (level_matrix.h, smoother_blocks.h, prolongator.h), with OST_COLUMNS side by side
 * (algebra/matrix/columns.h). They are in single precision, as the entries are: a register then holds all columns, and
 * an entry is read once for them. `one`: room for one vector of the length of x, or c, by which ghosts are exchanged.
 */

/* Collective over neighbours. y += scale A x. The matrix must not have a rest (ost_level_matrix_keep_rest). */
void ost_level_matrix_add_columns(const OstLevelMatrix *matrix, float scale, OstLightColumns *x, OstLightColumns *y,
                                  double *one);

/* Local. As ost_smoother_blocks_step, but `sum` is what all steps since the first add to x: so x, of double precision,
 * is read and written once for all. */
typedef struct OstColumnStep {
    float keep, add;
    OstLightColumns *direction, *sum;
    int is_first;
} OstColumnStep;
void ost_smoother_blocks_step_columns(const OstSmootherBlocks *blocks, const OstColumnStep *step,
                                      const OstLightColumns *r);

/* Collective over neighbours. x = P c, of double precision. */
void ost_prolongator_apply_columns(const OstProlongator *prolongator, OstLightColumns *c, OstColumns *x, double *one);

/* Collective over neighbours. c = Pᵀ x, x of double precision. */
void ost_prolongator_restrict_columns(const OstProlongator *prolongator, const OstColumns *x, OstLightColumns *c,
                                      double *one);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_COMPENSATED_STEP_H
#define ORTHOSTAT_ALGEBRA_MATRIX_COMPENSATED_STEP_H

#include "algebra/matrix/block_matrix.h"

/* Steps of flexible conjugate gradients (Notay, SIAM J. Sci. Comput. 22, 2000) with compensated products A p, for a
 * preconditioner M that is factors of a badly conditioned A. Rounding makes such factors wrong in the few softest
 * modes, so that refinement by them alone may diverge; and p·Ap in double precision is mere rounding. CG with
 * compensated products finds those modes in a few steps. */
typedef struct OstCompensatedStep {
    const OstBlockMatrix *matrix;
    double *direction; /* p, with room for ghosts */
    double *product;   /* A p */
    double energy;     /* p·Ap; 0 before the first step, and where it is not positive */
    double length;     /* of the step along p: it reduces the residual by length × A p */
} OstCompensatedStep;

/* Collective. */
OstStatus ost_compensated_step_create(const OstBlockMatrix *matrix, OstCompensatedStep **step);
void ost_compensated_step_destroy(OstCompensatedStep **step);

/* Collective. Replaces the correction M^-1 r by the step of conjugate gradients, but leaves it as it is if p·Ap is not
 * positive (then energy is 0 and length 1). `residual` and `correction` have 3 × rows numbers. */
OstStatus ost_compensated_step_turn(OstCompensatedStep *step, const double *residual, double *correction);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_COMPENSATED_STEP_H
#define ORTHOSTAT_ALGEBRA_MATRIX_COMPENSATED_STEP_H

#include "algebra/matrix/block_matrix.h"

/* Flexible conjugate gradients (Notay, SIAM J. Sci. Comput. 22, 2000) whose products are summed by
 * ost_compensated_residual. Factors of a badly conditioned matrix miss its softest modes by as much as they like, and
 * p·Ap in double precision is rounding: repeated, their steps diverge. As a preconditioner they leave those few modes
 * alone, which this finds. */
typedef struct OstCompensatedStep {
    const OstBlockMatrix *matrix;
    double *direction; /* p, with room for ghosts */
    double *product;   /* A p */
    double energy;     /* p·Ap; 0 before the first step, and where it is not positive */
    double length;     /* of the step, in p: it takes length × A p off the residual */
} OstCompensatedStep;

/* Collective. */
OstStatus ost_compensated_step_create(const OstBlockMatrix *matrix, OstCompensatedStep **step);
void ost_compensated_step_destroy(OstCompensatedStep **step);

/* Collective. Makes of the correction M^-1 r the step of conjugate gradients; leaves it as it is where p·Ap is not
 * positive. `residual` and `correction` have 3 × rows numbers. */
OstStatus ost_compensated_step_turn(OstCompensatedStep *step, const double *residual, double *correction);

#endif

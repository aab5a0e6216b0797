/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_NORM_H
#define ORTHOSTAT_ALGEBRA_SADDLE_NORM_H

#include "algebra/krylov/goal.h"
#include "algebra/saddle/coupling.h"

/* What stands beside A u = f in a mixed form (coupling.h). */
typedef struct OstSaddle {
    const OstCoupling *coupling;
    const double *g; /* coupling->rows */
    double *p;       /* coupling->columns; improved in place */
} OstSaddle;

/* Collective. The size of both right-hand sides, as forces: of f and of B' q, where q = S^-1 g is the pressure that g
 * is worth, and of what the nodes feel of g's energy g·q where its forces balance (over the mean diagonal of A). */
OstStatus ost_saddle_size(const OstBlockMatrix *matrix, const OstSaddle *saddle, const double *f, double *size);

/* Collective. Prepares the goal for both equations, that of f alone being set: `relative` is the residual asked for.
 * The norm is that of f - A u - B'p and of the forces B' q of the error of volume, and, relative to the energy of the
 * right-hand sides, that of the error of volume. */
OstStatus ost_saddle_goal(const OstBlockMatrix *matrix, const OstSaddle *saddle, const double *f, double relative,
                          OstGoal *goal);

/* Squares of a residual: of its forces, and of the energy of its error of volume. */
enum { OST_SADDLE_FORCE, OST_SADDLE_VOLUME, OST_SADDLE_SQUARES };

/* Collective. q = S^-1 r_p, with room for ghosts; `force` is work space of displacements. */
OstStatus ost_saddle_squares(const OstCoupling *coupling, const double *r_u, const double *r_p, double *q,
                             double *force, double squares[OST_SADDLE_SQUARES]);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_INTERPOLATION_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_INTERPOLATION_H

#include "algebra/matrix/geometry.h"
#include "algebra/matrix/scaling.h"

/* Between linear and quadratic tets of one body, in the scaled unknowns of both: a quadratic node takes the weighted
 * sum of its parents, P' = S_q^-T P S_l^T. It needs no matrix: four parents and weights a row say all. */
typedef struct OstInterpolation {
    OstContext *ctx;
    const OstScaling *quadratic, *linear; /* the caller's, which outlive it */
    const OstLocal *parents;              /* likewise; as in OstCoarseSpace */
    const double *weights;                /* of the parents */
    OstHalo *halo;                        /* over linear columns; the linear matrix' */
    double *fine;                         /* 3 × quadratic rows, unscaled */
    double *coarse;                       /* 3 × linear columns, unscaled */
} OstInterpolation;

OstStatus ost_interpolation_create(const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
                                   OstInterpolation **interpolation);
void ost_interpolation_destroy(OstInterpolation **interpolation);

/* Collective over neighbours. x += P' c, and c = P'ᵀ x; 3 × quadratic rows, 3 × linear rows. */
OstStatus ost_interpolation_add(const OstInterpolation *interpolation, const double *c, double *x);
OstStatus ost_interpolation_restrict(const OstInterpolation *interpolation, const double *x, double *c);

#endif

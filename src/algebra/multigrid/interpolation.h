/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_INTERPOLATION_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_INTERPOLATION_H

#include "algebra/matrix/geometry.h"
#include "algebra/matrix/scaling.h"

/* Interpolation from linear to quadratic tets of one body, in scaled unknowns: P' = S_q^-T P S_l^T, where P gives a
 * quadratic node the weighted sum of its parents (OstCoarseSpace). Applied without a matrix. */
typedef struct OstInterpolation {
    OstContext *ctx;
    const OstScaling *quadratic, *linear; /* the caller's, like the next three; they outlive it */
    const OstLocal *parents;              /* as in OstCoarseSpace */
    const double *weights;                /* of the parents */
    OstHalo *halo;                        /* of the linear matrix */
    double *fine;                         /* 3 × quadratic rows, unscaled */
    double *coarse;                       /* 3 × linear columns, unscaled */
} OstInterpolation;

OstStatus ost_interpolation_create(const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
                                   OstInterpolation **interpolation);
void ost_interpolation_destroy(OstInterpolation **interpolation);

/* Collective over neighbours. x += P' c, and c = P'ᵀ x; x has 3 × quadratic rows numbers, c 3 × linear rows. */
OstStatus ost_interpolation_add(const OstInterpolation *interpolation, const double *c, double *x);
OstStatus ost_interpolation_restrict(const OstInterpolation *interpolation, const double *x, double *c);

#endif

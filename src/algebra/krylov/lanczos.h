/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_LANCZOS_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_LANCZOS_H

#include "orthostat/context.h"

/* The coefficients of a run of conjugate gradients, which define the Lanczos matrix of the preconditioned operator. */
typedef struct OstLanczos {
    OstContext *ctx;
    int most; /* steps that are kept */
    int room; /* for so many at present */
    int count;
    double *alpha;  /* step lengths */
    double *weight; /* r·z before each step; weight[k] / weight[k - 1] made the direction of step k */
} OstLanczos;

/* Local. Of at most `steps` steps; later ones are not kept. */
OstStatus ost_lanczos_create(OstContext *ctx, int steps, OstLanczos *lanczos);
void ost_lanczos_destroy(OstLanczos *lanczos);

/* Collective, as it may need more room. */
OstStatus ost_lanczos_add(OstLanczos *lanczos, double alpha, double weight);

/* Local. The smallest and the largest eigenvalue of the Lanczos matrix, which approach those of the preconditioned
 * matrix from above and from below; 0 if there were no steps. */
void ost_lanczos_extremes(const OstLanczos *lanczos, double *smallest, double *largest);

#endif

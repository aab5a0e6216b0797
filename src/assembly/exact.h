/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_EXACT_H
#define ORTHOSTAT_ASSEMBLY_EXACT_H

#include "orthostat/context.h"

/* A displacement field known in closed form, with the stress and the force per volume that belong to it in the scene's
 * material. It stands behind the word `exact` in constraints and loads, and is what the answer is measured against.
 * Every function is local and may be called at any point of the body or (by a little) beside it. */
typedef struct OstExactField {
    const void *data; /* handed to the functions */
    OstStatus (*displacement)(const void *data, const double point[3], double u[3]);
    OstStatus (*gradient)(const void *data, const double point[3], double gradient[9]); /* du_i/dx_j at 3i + j */
    OstStatus (*stiffness)(const void *data, const double point[3], double c[36]);      /* in world axes */
    OstStatus (*stress)(const void *data, const double point[3], double stress[6]);     /* 11 22 33 12 23 31 */
    OstStatus (*body_force)(const void *data, const double point[3],
                            double force[3]); /* minus the stress's divergence */
} OstExactField;

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_CLOSED_FORM_H
#define ORTHOSTAT_ASSEMBLY_CLOSED_FORM_H

#include "orthostat/context.h"

/* A closed-form solution: a displacement field, with its stress and force per volume in the scene's material. The
 * case's word `exact` in constraints and loads means this field, and the computed solution is compared with it. Every
 * function is local and may be called at any point of the body, or slightly outside it. */
typedef struct OstClosedForm {
    const void *data; /* argument of the functions */
    OstStatus (*displacement)(const void *data, const double point[3], double u[3]);
    OstStatus (*gradient)(const void *data, const double point[3], double gradient[9]); /* du_i/dx_j at 3i + j */
    OstStatus (*stiffness)(const void *data, const double point[3], double c[36]);      /* in world axes */
    OstStatus (*stress)(const void *data, const double point[3], double stress[6]);     /* 11 22 33 12 23 31 */
    OstStatus (*body_force)(const void *data, const double point[3],
                            double force[3]); /* minus the stress's divergence */
} OstClosedForm;

#endif

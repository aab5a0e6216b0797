/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_COARSE_SPACE_H
#define ORTHOSTAT_PROBLEM_COARSE_SPACE_H

#include "problem/row_geometry.h"

/* The linear tets under a body of quadratic ones, with their own stiffness: what p-multigrid corrects the quadratic
 * answer by. */
typedef struct OstLinearSpace {
    OstMesh *mesh;
    OstSupports *supports;
    OstSystem *system;
    OstRowGeometry rows;
    OstLocal *parents;
    double *weights;
    OstCoarseSpace space; /* what the solver takes; points into this struct */
} OstLinearSpace;

/* Collective. The linear space under a quadratic system; `with_metric` as for the quadratic rows. NULL comes back where
 * there is none: its vertices are all held. OST_EFFECT_LINEAR_SPACE.
 */
OstStatus ost_linear_space_create(const OstSystem *quadratic, const OstMaterialField *field, int with_metric,
                                  OstLinearSpace **space);
void ost_linear_space_destroy(OstLinearSpace **space);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_COARSE_SPACE_H
#define ORTHOSTAT_PROBLEM_COARSE_SPACE_H

#include "problem/row_geometry.h"

/* The linear tets under a body of quadratic ones, with their own stiffness: the coarse level of p-multigrid. */
typedef struct OstLinearSpace {
    OstMesh *mesh;
    OstSupports *supports;
    OstSystem *system;
    OstRowGeometry rows;
    OstLocal *parents;
    double *weights;
    OstCoarseSpace space; /* what the solver is given; points into this struct */
} OstLinearSpace;

/* Collective. The linear space under a quadratic system; `with_metric` as for the quadratic rows. NULL if all its
 * vertices are constrained. OST_EFFECT_LINEAR_SPACE. */
OstStatus ost_linear_space_create(const OstSystem *quadratic, const OstMaterialField *field, int with_metric,
                                  OstLinearSpace **space);
void ost_linear_space_destroy(OstLinearSpace **space);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_COARSE_SPACE_H
#define ORTHOSTAT_PROBLEM_COARSE_SPACE_H

#include "problem/row_geometry.h"

/* The linear tets under a body of quadratic ones, with their own stiffness: the coarse level of p-multigrid. */
typedef struct OstLinearSpace {
    OstMesh *mesh;
    OstSupports *supports;
    OstLocal *node_of_vertex; /* of the quadratic mesh */
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

/* Collective. Takes the linear space to a displacement of the quadratic tets' nodes (3 × node_count): its stiffness and
 * its rigid motions there. The stiffness is that of large rotations made definite, as a coarse level's must be. */
OstStatus ost_linear_space_move(OstLinearSpace *space, const OstMaterialField *field, OstFormulation formulation,
                                const double *displacement);
void ost_linear_space_destroy(OstLinearSpace **space);

/* Local. Interpolation of a quadratic system's rows from a linear one of the same tets: for each row four columns of
 * the linear matrix (-1: none, or constrained) and their weights. A node on a straight edge takes the mean of the
 * edge's ends. One on a curved edge lies off that mean, and is interpolated (or extrapolated) in a tet at the edge, so
 * that rotations and uniform strains of the body are reproduced. Both arrays, 4 × rows, are the caller's. */
OstStatus ost_coarse_parents(const OstSystem *quadratic, const OstSystem *linear, OstLocal **parents, double **weights);

#endif

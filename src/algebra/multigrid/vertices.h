/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_VERTICES_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_VERTICES_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/prolongator.h"
#include "algebra/matrix/geometry.h"
#include "algebra/matrix/scaling.h"

/* The vertices of quadratic tets as their first coarse level, with six unknowns each: a displacement u and a rotation
 * w. A fine node x moves by the sum, over its parents v with weights a, of a (u + w × (x - v) / 2). A mid-edge node
 * thus leaves the line between its ends as they turn, as in the tets with vertex rotations of Allman (1984): the space
 * holds every rigid motion, and bends along any direction without stretching along it. */
typedef struct OstVertexSpace {
    OstProlongator *prolongator; /* in scaled unknowns */
    double *modes;               /* rigid body modes of the vertices: OST_MODES columns of OST_MODES × vertices */
    OstMetricGraph *graph;       /* of the vertices */
    OstGlobal first;             /* global number of this rank's first vertex */
} OstVertexSpace;

/* Collective. `geometry` and `scaling` are the quadratic tets', `linear` that of the linear ones of `space`. */
OstStatus ost_vertex_space_create(const OstCoarseSpace *space, const OstSolverGeometry *geometry,
                                  const OstScaling *scaling, const OstScaling *linear, OstVertexSpace *vertices);
void ost_vertex_space_clear(OstVertexSpace *vertices);

#endif

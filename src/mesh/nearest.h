/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_NEAREST_H
#define ORTHOSTAT_MESH_NEAREST_H

#include "mesh/mesh_data.h"

/* The vertex nearest to a point, over all ranks. */
typedef struct OstNearest {
    OstLocal node; /* on its owner; elsewhere -1 */
    int owner;
    double distance; /* from the point */
    double at[3];
} OstNearest;

/* Collective. Mid-edge nodes do not count, so that the answer is the same for linear and quadratic tets. Of equally
 * near vertices it is the one with the lowest label, on any number of ranks. */
OstStatus ost_mesh_nearest(const OstMesh *mesh, const double place[3], OstNearest *vertex);

/* Collective. Lengths of the shortest and of the longest edge at such a vertex. */
OstStatus ost_mesh_edges_at(const OstMesh *mesh, const OstNearest *vertex, double *shortest, double *longest);

#endif

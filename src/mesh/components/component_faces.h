/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COMPONENTS_COMPONENT_FACES_H
#define ORTHOSTAT_MESH_COMPONENTS_COMPONENT_FACES_H

#include "mesh/mesh_data.h"

/* The labels of two tets on the same side of a face: they overlap, or one is a duplicate. */
typedef struct OstOverlap {
    int found;
    OstGlobal low, high; /* of all such pairs the one with the lowest `low`, then the lowest `high` */
} OstOverlap;

/* Local. Joins this rank's tets, ghosts included, through the faces that touch an owned node (it has the tets on both
 * sides of these), and numbers the sets: set[t] in 0 .. *set_count - 1. */
OstStatus ost_component_faces_join(const OstMesh *mesh, OstLocal *set, OstLocal *set_count, OstOverlap *overlap);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COMPONENTS_COMPONENT_FACES_H
#define ORTHOSTAT_MESH_COMPONENTS_COMPONENT_FACES_H

#include "mesh/mesh_data.h"

/* Two tets on the same side of a face, by label: they overlap, or one is doubled. */
typedef struct OstOverlap {
    int found;
    OstGlobal low, high; /* of all such pairs, the first in this order */
} OstOverlap;

/* Local. Joins the tets held here through those faces that touch an owned node (the tets on both sides of these are
 * here), and numbers the sets: set[t] in 0 .. *set_count - 1. */
OstStatus ost_component_faces_join(const OstMesh *mesh, OstLocal *set, OstLocal *set_count, OstOverlap *overlap);

#endif

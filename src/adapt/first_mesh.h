/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_FIRST_MESH_H
#define ORTHOSTAT_ADAPT_FIRST_MESH_H

#include "problem/scene_data.h"

/* What a case selects on its first mesh, for the problem to be the same on finer ones. */
typedef struct OstFirstMesh {
    OstWatch *watch; /* the case's, as the three below, with each `nearest` place taken to the vertex there */
    OstLoad *load;
    OstConstraint *constraint;
    OstSpring *spring;
    double *area; /* of the faces that each load, constraint and spring selects by a box, a sphere or a cylinder; NAN:
                     not looked at */
} OstFirstMesh;

/* Collective. Gives the case of the first scene these lists, which `first` owns; warns of watched places that have no
 * vertex near. The caller clears `first` after all scenes, in any case. */
OstStatus ost_first_mesh_keep(const OstScene *scene, OstCase *c, OstFirstMesh *first);
void ost_first_mesh_clear(OstFirstMesh *first);

/* Collective. Warns of a selection whose faces cover another area than on the first mesh, by more than the share: the
 * border of a box that is no line of the mesh. Once for each. */
OstStatus ost_first_mesh_compare(OstFirstMesh *first, const OstScene *scene, double share);

#endif

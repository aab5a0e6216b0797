/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LINKS_FACE_SEARCH_H
#define ORTHOSTAT_ASSEMBLY_LINKS_FACE_SEARCH_H

#include "mesh/mesh_data.h"

/* Faces of all ranks, on every rank, to find the nearest point of: their memory goes with the surface. */
typedef struct OstFaceSearch OstFaceSearch;

/* Collective. Of faces as assembly/loads.h lists them. Raises OST_INVALID_INPUT if there is none. */
OstStatus ost_face_search_create(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                                 OstFaceSearch **search);
void ost_face_search_destroy(OstFaceSearch **search);

/* How a point x moves with a face, by the face's nodes (node_number) and a 3×3 weight for each: as the nearest point of
 * the face, and from there to x along a lever that turns with the face, so that the tie passes moments on. */
typedef struct OstFacePoint {
    int count;
    OstGlobal number[6];
    double weight[6][9];
    double distance;
    double gap;                           /* that, over the size of the face */
    double share[6], slope[6][2], across; /* of the lever (levers.h) */
} OstFacePoint;

/* Local. By the point nearest to x; of a curved face, the one over the nearest point of its three vertices' triangle.
 */
void ost_face_search_nearest(const OstFaceSearch *search, const double x[3], OstFacePoint *found);

#endif

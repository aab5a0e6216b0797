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

/* A point of a face, by the face's nodes (node_number) and their shape functions there. */
typedef struct OstFacePoint {
    int count;
    OstGlobal number[6];
    double weight[6];
    double place[3], distance;
} OstFacePoint;

/* Local. The point nearest to x; of a curved face, the one over the nearest point of its three vertices' triangle. */
void ost_face_search_nearest(const OstFaceSearch *search, const double x[3], OstFacePoint *found);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COMPONENTS_COMPONENT_H
#define ORTHOSTAT_MESH_COMPONENTS_COMPONENT_H

#include "mesh/mesh_data.h"

/* A connected component: tets joined through faces. Components that touch only at an edge or a vertex are hinged there.
 */
typedef struct OstComponent {
    OstGlobal tets;
    OstGlobal first_tet; /* its lowest number of a tet in the file */
    double low[3], high[3];
} OstComponent;

typedef struct OstComponents {
    OstContext *ctx;
    OstLocal count;          /* over the whole body */
    OstLocal *of_tet;        /* tet_count: the component of each local tet, ghosts included */
    OstComponent *component; /* count: the same on every rank, in the order of first_tet */
} OstComponents;

/* Collective. Raises OST_INVALID_INPUT with the labels of two tets if tets lie on the same side of a face. */
OstStatus ost_components_create(const OstMesh *mesh, OstComponents **components);
void ost_components_destroy(OstComponents **components);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_PART_H
#define ORTHOSTAT_MESH_PART_H

#include "orthostat/mesh.h"

/* A part: tets joined through faces. Such a set moves as one where it does not deform; parts that touch in an edge or a
 * vertex alone are hinged there. */
typedef struct OstPart {
    OstGlobal tets;
    OstGlobal first_tet; /* its lowest label */
    double low[3], high[3];
} OstPart;

typedef struct OstParts {
    OstContext *ctx;
    OstLocal count;   /* over the whole body */
    OstLocal *of_tet; /* tet_count: the part of each tet held here */
    OstPart *part;    /* count: the same on every rank, in the order of first_tet */
} OstParts;

/* Collective. Raises OST_INVALID_INPUT, naming two tets, where tets lie on the same side of a face. */
OstStatus ost_parts_create(const OstMesh *mesh, OstParts **parts);
void ost_parts_destroy(OstParts **parts);

#endif

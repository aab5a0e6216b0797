/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBE_LOCATE_H
#define ORTHOSTAT_PROBE_LOCATE_H

#include "mesh/mesh_data.h"

/* Where a point lies in the body. */
typedef struct OstLocated {
    OstGlobal label; /* of the tet, on all ranks; 0: the point is outside the body */
    OstLocal tet;    /* on the rank that owns it, or -1 */
    double at[4];    /* barycentric coordinates, on that rank */
} OstLocated;

/* Collective. The tet of each of `count` points (all ranks pass the same): of several that hold it, on a face between
 * them, the one with the lowest label. A point that no tet holds, but one misses by less than a twentieth of its
 * height, belongs to that tet: a surface is curved, and its faces may be plane. */
OstStatus ost_locate(const OstMesh *mesh, OstLocal count, const double *points, OstLocated *located);

#endif

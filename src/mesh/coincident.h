/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COINCIDENT_H
#define ORTHOSTAT_MESH_COINCIDENT_H

#include "mesh/mesh_data.h"

/* This rank's points: their global numbers start at `first`, contiguous over ranks. */
typedef struct OstPoints {
    OstContext *ctx;
    OstGlobal first;
    OstLocal count;
    const double *coordinates; /* count × 3 */
} OstPoints;

/* Collective. For each of this rank's points, the lowest number of a point within `tolerance` of it, on any rank: its
 * own if it coincides with none of a lower number. */
OstStatus ost_coincident_find(const OstPoints *points, double tolerance, OstGlobal *lowest);

/* Collective. The number of vertices that coincide with others to `tolerance`: a hundredth of the shortest edge,
 * rounded down to one digit. Joining them to this tolerance cannot make a tet collapse. Those that are `joined` in
 * another way (owned_nodes; NULL: none) do not count. */
OstStatus ost_mesh_count_coincident(const OstMesh *mesh, const unsigned char *joined, OstGlobal *count,
                                    double *tolerance);

#endif

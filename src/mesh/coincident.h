/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COINCIDENT_H
#define ORTHOSTAT_MESH_COINCIDENT_H

#include "mesh/mesh_data.h"

/* Points of all ranks, each rank's numbered from `first` on, contiguously over ranks. */
typedef struct OstPoints {
    OstContext *ctx;
    OstGlobal first;
    OstLocal count;
    const double *coordinates; /* count × 3 */
} OstPoints;

/* Collective. For each of this rank's points the lowest number of a point within `tolerance` of it, on any rank: its
 * own where it coincides with none before it. */
OstStatus ost_coincident_find(const OstPoints *points, double tolerance, OstGlobal *lowest);

/* Collective. How many vertices of the body coincide with others, to a hundredth of the shortest edge: to `tolerance`,
 * rounded down to one digit, which joins them and can make no tet collapse. */
OstStatus ost_mesh_count_coincident(const OstMesh *mesh, OstGlobal *count, double *tolerance);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_HEXES_H
#define ORTHOSTAT_MESH_HEXES_H

#include "mesh/mesh_data.h"

enum { HEX_TETS = 6, HEX_CORNERS = 8 };

/* A mesh of hexes, each divided in six tets along the diagonal from corner 0 to corner 7 (Kuhn). Corner numbers are
 * bits: 1 for a step in the first direction, 2 in the second, 4 in the third, which form a right-handed system.
 * Neighbours match if the diagonals of the face they share do. */
typedef struct Hexes {
    const char *name, *region; /* for messages; of the one region */
    OstGlobal nodes, cells;
    int sides; /* boundaries of faces */
    const void *shape;
    void (*place)(const void *shape, OstGlobal node, double x[3]);
    void (*corners)(const void *shape, OstGlobal cell, OstGlobal corner[HEX_CORNERS]);
    const char *(*side_name)(const void *shape, int side);
    int (*ends)(const void *shape, int side, OstGlobal cell, int *direction); /* at which a cell touches a side */
} Hexes;

enum { HEX_LOW = 1, HEX_HIGH = 2 }; /* ends of a direction */

/* Collective. Each rank makes its share of the nodes and of the tets, contiguous and equal to within one cell. Faces
 * are oriented outwards. Raises OST_LIMIT_EXCEEDED if a rank could not number its tets. */
OstStatus ost_hexes_create_chunk(OstContext *ctx, const Hexes *hexes, OstMeshChunk **chunk);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_HEXES_H
#define ORTHOSTAT_MESH_HEXES_H

#include "mesh/mesh_data.h"

enum { HEX_TETS = 6, HEX_CORNERS = 8 };

/* A mesh of hexes, each divided into six tets along the diagonal from corner 0 to corner 7 (Kuhn). The bits of a
 * corner's number are steps: 1 in the first direction, 2 in the second, 4 in the third; these form a right-handed
 * system. Neighbours conform if both divide their common face by the same diagonal. */
typedef struct Hexes {
    const char *name;   /* for messages */
    const char *region; /* name of the only region */
    OstGlobal nodes, cells;
    int sides; /* boundaries of faces */
    const void *shape;
    void (*place)(const void *shape, OstGlobal node, double x[3]);
    void (*corners)(const void *shape, OstGlobal cell, OstGlobal corner[HEX_CORNERS]);
    const char *(*side_name)(const void *shape, int side);
    int (*ends)(const void *shape, int side, OstGlobal cell,
                int *direction); /* the ends at which a cell is on a side */
} Hexes;

enum { HEX_LOW = 1, HEX_HIGH = 2 }; /* ends of a direction */

/* Collective. Each rank makes a contiguous share of the nodes and of the cells, equal to within one. Faces are oriented
 * outwards. Raises OST_LIMIT_EXCEEDED if a rank could not number its tets. */
OstStatus ost_hexes_create_chunk(OstContext *ctx, const Hexes *hexes, OstMeshChunk **chunk);

#endif

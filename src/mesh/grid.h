/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_GRID_H
#define ORTHOSTAT_MESH_GRID_H

#include "orthostat/mesh.h"

/* A box of hexes in index space, nodes numbered with the last index fastest, each hex divided in six tets along the
 * diagonal from its lowest to its highest corner (Kuhn). The three index directions form a right-handed system. */
typedef struct Grid {
    const char *name; /* for messages, and of the one region */
    OstLocal cells[3];
    int round[3]; /* does the index go round? then the last node is the first again */
    const void *shape;
    void (*place)(const void *shape, const OstGlobal index[3], double x[3]);
} Grid;

enum { GRID_LOW = 1, GRID_HIGH = 2 };

/* A boundary: one or both ends of an index direction. */
typedef struct GridSide {
    const char *name;
    int direction;
    int ends; /* GRID_LOW | GRID_HIGH */
} GridSide;

/* Collective. Each rank makes its share of the nodes and of the tets. Faces are oriented outwards. */
OstStatus ost_grid_create_chunk(OstContext *ctx, const Grid *grid, int side_count, const GridSide *sides,
                                OstMeshChunk **chunk);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_SHAPES_GRID_H
#define ORTHOSTAT_MESH_SHAPES_GRID_H

#include "mesh/hexes.h"

/* A box of hexes in index space (mesh/hexes.h), with nodes numbered last index fastest. The index directions form a
 * right-handed system. */
typedef struct Grid {
    const char *name; /* of the shape, in messages, and of its only region */
    OstLocal cells[3];
    int round[3]; /* is the direction closed to a ring? Then its last node is its first */
    const void *shape;
    void (*place)(const void *shape, const OstGlobal index[3], double x[3]);
} Grid;

/* A boundary: one or both ends of an index direction. */
typedef struct GridSide {
    const char *name;
    int direction;
    int ends; /* HEX_LOW | HEX_HIGH */
} GridSide;

/* Collective, as ost_hexes_create_chunk. */
OstStatus ost_grid_create_chunk(OstContext *ctx, const Grid *grid, int side_count, const GridSide *sides,
                                OstMeshChunk **chunk);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_CELLS_SHAPES_H
#define ORTHOSTAT_FORMATS_CELLS_SHAPES_H

#include "formats/cells/cells.h"

enum { OST_MOST_CELL_NODES = 27 };

/* Nodes of a cell by their places in it. */
typedef struct OstCellShape {
    const char *name[2]; /* of one, of several */
    int vertices, edges, faces;
    int edge[12][2]; /* their middles follow the vertices */
    int face[6][4];  /* with normals into the cell; the last of a triangle is -1 */
    int middle[6];   /* of each face, where the cell has it: a node beyond its count, or 0, is none */
    int centre;      /* likewise */
} OstCellShape;

/* The shape of a kind that is split, or of tets; NULL of another. */
const OstCellShape *ost_cell_shape(OstCellKind kind);

#endif

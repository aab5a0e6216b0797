/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/cells/shapes.h"

#include <stddef.h>

/* Vertices and edges as VTK numbers them, faces as Abaqus does. */

static const OstCellShape tet = {.name = {"tet", "tets"},
                                 .vertices = 4,
                                 .edges = 6,
                                 .faces = 4,
                                 .edge = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}},
                                 .face = {{0, 1, 2, -1}, {0, 3, 1, -1}, {1, 3, 2, -1}, {2, 3, 0, -1}}};

static const OstCellShape pyramid = {.name = {"pyramid", "pyramids"},
                                     .vertices = 5,
                                     .edges = 8,
                                     .faces = 5,
                                     .edge = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
                                     .face = {{0, 1, 2, 3}, {0, 4, 1, -1}, {1, 4, 2, -1}, {2, 4, 3, -1}, {3, 4, 0, -1}},
                                     .middle = {13}};

static const OstCellShape wedge = {.name = {"wedge", "wedges"},
                                   .vertices = 6,
                                   .edges = 9,
                                   .faces = 5,
                                   .edge = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
                                   .face = {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}},
                                   .middle = {0, 0, 15, 16, 17}};

static const OstCellShape hexahedron = {
    .name = {"hexahedron", "hexahedra"},
    .vertices = 8,
    .edges = 12,
    .faces = 6,
    .edge = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
    .face = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}},
    .middle = {24, 25, 22, 21, 23, 20},
    .centre = 26};

static const OstCellShape quadrilateral = {.name = {"quadrilateral", "quadrilaterals"},
                                           .vertices = 4,
                                           .edges = 4,
                                           .faces = 1,
                                           .edge = {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                                           .face = {{0, 1, 2, 3}},
                                           .middle = {8}};

const OstCellShape *ost_cell_shape(OstCellKind kind)
{
    if (kind < OST_CELL_TET4 || kind >= OST_CELL_KINDS)
        return NULL;
    return kind <= OST_CELL_TET10       ? &tet
           : kind <= OST_CELL_PYRAMID14 ? &pyramid
           : kind <= OST_CELL_WEDGE18   ? &wedge
           : kind <= OST_CELL_HEX27     ? &hexahedron
                                        : &quadrilateral;
}

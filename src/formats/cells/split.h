/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_CELLS_SPLIT_H
#define ORTHOSTAT_FORMATS_CELLS_SPLIT_H

#include "core/index_map.h"
#include "formats/cells/cells.h"

/* Hexahedra, wedges and pyramids become tets, quadrilaterals triangles. The diagonal of a face goes through the
 * vertex that is first along a direction, so that neighbours of any kind agree (J. Dompierre, P. Labbé, M.-G. Vallet
 * and R. Camarero, How to subdivide pyramids, prisms and hexahedra into tetrahedra, 8th International Meshing
 * Roundtable, 1999). A cell in which nodes repeat, such as a hexahedron that was collapsed into a wedge, has the faces
 * that are left. */

typedef struct OstSplit {
    OstMeshChunk *chunk; /* whose nodes the cells have; it gets those in the middle of diagonals */
    const char *path;
    OstGlobal next_label;
    OstIndex *diagonals;             /* by the nodes at their ends; NULL: none yet */
    OstLocal *middle;                /* of each diagonal */
    OstGlobal cells[OST_CELL_KINDS]; /* that were split */
    OstGlobal tets;                  /* that solids were split into */
} OstSplit;

/* Tets or triangles of a cell: vertices, then mid-edge nodes. Positions of nodes, as those of cells here. */
enum { OST_MOST_PIECES = 6 };
typedef struct OstPieces {
    int count;
    OstGlobal nodes[OST_MOST_PIECES][10];
} OstPieces;

void ost_split_open(OstMeshChunk *chunk, const char *path, OstSplit *split);
void ost_split_close(OstSplit *split);

/* Local. The pieces of a cell of a kind that is split. Raises OST_INVALID_INPUT if there are none. */
OstStatus ost_split_cell(OstSplit *split, OstCellKind kind, OstGlobal label, const OstGlobal *nodes, OstPieces *pieces);

/* The same without mid-edge nodes, and without a word. */
void ost_split_vertices(const OstMeshChunk *chunk, OstCellKind kind, const OstGlobal *nodes, OstPieces *pieces);

/* Says what was split into how many tets. */
void ost_split_say(const OstSplit *split);

#endif

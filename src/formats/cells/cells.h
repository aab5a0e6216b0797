/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_CELLS_CELLS_H
#define ORTHOSTAT_FORMATS_CELLS_CELLS_H

#include "formats/serial/label_index.h"
#include "mesh/mesh_data.h"

/* A mesh as other programs have it, while its file is read: nodes and elements by number and in any order, and sets of
 * them. Memory grows with what is read, never with a count that a file states. */

/* Nodes come in VTK's order, as of its quadratic cells: mid-edge nodes of a tet are 01 12 02 03 13 23, those of a
 * triangle 01 12 20 (shapes.c has the others). The triangle 012 of a wedge may be seen from either side. */
typedef enum {
    OST_CELL_POINT,
    OST_CELL_LINE2,
    OST_CELL_LINE3,
    OST_CELL_TRIANGLE3,
    OST_CELL_TRIANGLE6,
    OST_CELL_TET4,
    OST_CELL_TET10,
    OST_CELL_PYRAMID5, /* from here on cells are split (split.h): solids, then */
    OST_CELL_PYRAMID13,
    OST_CELL_PYRAMID14,
    OST_CELL_WEDGE6,
    OST_CELL_WEDGE15,
    OST_CELL_WEDGE18,
    OST_CELL_HEX8,
    OST_CELL_HEX20,
    OST_CELL_HEX27,
    OST_CELL_QUAD4, /* faces */
    OST_CELL_QUAD8,
    OST_CELL_QUAD9,
    OST_CELL_KINDS
} OstCellKind;

typedef struct OstCellFacts {
    int dimension, nodes;
} OstCellFacts;
extern const OstCellFacts ost_cell_facts[OST_CELL_KINDS];

/* All cells of a kind. */
typedef struct OstCellList {
    OstLocal count;
    OstGlobal *nodes; /* count × nodes: labels */
    OstGlobal *label;
    OstGlobal *group; /* a number, or OST_NO_GROUP */
} OstCellList;
#define OST_NO_GROUP INT64_MIN

/* The name of a group of cells; without one it is volume-7, surface-7, ... by its number. */
typedef struct OstCellName {
    int dimension; /* -1: any */
    OstGlobal group;
    char *name;
} OstCellName;

/* A named list of nodes, of cells, or of faces of solids; of cells that stand for their free faces, or, if they are
 * faces, for themselves; of sides of tets: what ost_cells_make_faces makes of nodes. */
typedef enum { OST_SET_OF_NODES, OST_SET_OF_CELLS, OST_SET_OF_FACES, OST_SET_OF_FREE, OST_SET_OF_SIDES } OstSetKind;
typedef struct OstCellSet {
    OstSetKind kind;
    char *name;
    int is_region; /* of cells: may be a region if it holds tets; else it only bounds */
    OstLocal count;
    OstGlobal *item; /* labels; of faces: as ost_cell_face makes them; of sides: 4 × the tet's position + the vertex
                        opposite */
} OstCellSet;

/* A face of a solid, by the solid's label and the face's number from 0, in the order of Abaqus's S1, S2, ...
 * (shapes.c).
 */
enum { OST_CELL_FACES = 8 };
static inline OstGlobal ost_cell_face(OstGlobal label, int face)
{
    return OST_CELL_FACES * label + face;
}

typedef struct OstCells {
    OstContext *ctx;
    const char *path; /* for messages; the caller's */
    OstMeshChunk *chunk;
    OstCellList list[OST_CELL_KINDS];
    int name_count;
    OstCellName *name;
    int (*same_names)(const char *a, const char *b); /* of sets; NULL: to the letter */
    int set_count;
    OstCellSet *set;
    OstGlobal solids, others; /* that are not read; that are neither solids, faces, lines nor points */
    char solid[48], other[48];
    OstGlobal missing;    /* items of sets that are not in the file */
    OstLabelIndex nodes;  /* label to position; then */
    OstLabelIndex labels; /* of cells of all kinds, kind after kind */
} OstCells;

/* Local. `path` outlives the cells. */
OstStatus ost_cells_open(OstContext *ctx, const char *path, OstCells *cells);
void ost_cells_close(OstCells *cells);

/* Local. Add a node; a cell with the labels of its nodes and its group. Labels are 0 to OST_LARGEST_LABEL. */
OstStatus ost_cells_add_node(OstCells *cells, OstGlobal label, const double x[3]);
OstStatus ost_cells_add(OstCells *cells, OstCellKind kind, OstGlobal label, OstGlobal group, const OstGlobal *nodes);

/* Local. Counts a cell of another kind: solids are refused in the end, others are left out with a warning. */
void ost_cells_skip(OstCells *cells, int dimension, const char *shape);

/* Local. Names a group of cells of a dimension, or (-1) of any. */
OstStatus ost_cells_name(OstCells *cells, int dimension, OstGlobal group, const char *name);

/* Local. The set of a name: a new one if there is none; or -1. Sets hold what
 * is put into them, perhaps before the file defines it. */
OstStatus ost_cells_set(OstCells *cells, OstSetKind kind, const char *name, int *set);
int ost_cells_find_set(const OstCells *cells, OstSetKind kind, const char *name);
OstStatus ost_cells_put(OstCells *cells, int set, OstGlobal item);

/* Local. Keeps each item of a set once. Puts the items of one set into another, each once; or those of the numbers
 * first, first + step, ... last that nodes or cells have. */
void ost_cells_keep_once(OstCells *cells, int set);
OstStatus ost_cells_put_set(OstCells *cells, int set, int from);
OstStatus ost_cells_put_range(OstCells *cells, int set, OstGlobal first, OstGlobal last, OstGlobal step);

/* Local. Puts the nodes of a quadratic kind that are no vertices, which a format has in no known order, where
 * formats/cells wants them: by where they lie in all cells together. Labels of nodes are 1, 2, 3, ... */
OstStatus ost_cells_order_middles(OstCells *cells, OstCellKind kind);

/* Local. Makes the chunk: other solids become tets; sets and groups of tets become regions (a tet in several goes to
 * the one with the fewest), those of triangles, lines, points, nodes and faces become boundaries; what is no part of
 * the body is left out with warnings. Raises OST_INVALID_INPUT for solids that are not read, for nodes that are not
 * there and for labels that occur twice. `chunk` is then the caller's. */
OstStatus ost_cells_finish(OstCells *cells, OstMeshChunk **chunk);

/* Local. The steps of that. Once nodes and labels are indexed, splits solids that are no tets, if there are any, and
 * the faces of four corners with them; sets and groups keep what they held. */
int ost_cells_must_split(const OstCells *cells);
OstStatus ost_cells_split(OstCells *cells);
OstStatus ost_cells_make_regions(OstCells *cells, OstCellKind tets);
OstStatus ost_cells_make_boundaries(OstCells *cells, OstCellKind tets);

/* Local. Sets of nodes that hold whole faces of the surface, and nothing beside them, become sets of these faces,
 * unless another set or group has the name that bounds too. Free faces of solids, which no other solid has, join those
 * that their set's name has. */
OstStatus ost_cells_make_faces(OstCells *cells, OstCellKind tets);

/* The face of a tet opposite a vertex: its vertices, then (of quadratic tets) mid-edge nodes 01 12 20. */
void ost_cell_face_of(const OstGlobal *tet, int nodes_per_tet, int opposite, OstGlobal face[6]);

/* Local. Where a cell is, by its label: its kind and position, or a kind of OST_CELL_KINDS. */
OstCellKind ost_cells_find(const OstCells *cells, OstGlobal label, OstLocal *position);

#endif

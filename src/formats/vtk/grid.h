/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTK_GRID_H
#define ORTHOSTAT_FORMATS_VTK_GRID_H

#include "formats/cells/cells.h"
#include "formats/msh/cursor.h"
#include "formats/serial/formats.h"

/* VTK's files of other programs, .vtk, .vtu and .vtkhdf: an unstructured grid in memory. */

enum { OST_VTK_NAME = 1024 }; /* that of an array may be the names of many sets (sets.c) */

/* Numbers of points or of cells. Only those that are asked for are kept. */
typedef struct OstVtkArray {
    char name[OST_VTK_NAME];
    int on_points;
    int components;
    OstGlobal tuples;
    double *values; /* tuples × components */
} OstVtkArray;

/* What the number of a region or boundary is called. */
typedef struct OstVtkName {
    int dimension;
    OstGlobal number;
    char name[OST_VTK_NAME];
} OstVtkName;

typedef struct OstVtkGrid {
    OstContext *ctx;
    const char *path;
    const char *wanted;  /* a field's name; NULL: arrays that may say which region a cell is in */
    OstFileField *field; /* of that name; or NULL */
    int by_meshio;       /* it wrote the file, and may have put sets into an array */
    OstGlobal points, cells;
    double *coordinates;
    OstGlobal *end; /* of each cell in the connectivity */
    OstGlobal connections;
    OstGlobal *connectivity;
    unsigned char *type;
    int piece_count;
    OstGlobal *piece_start; /* first point of each piece */
    OstGlobal *same;        /* the point that stands for each one; NULL: each for itself */
    int array_count;
    OstVtkArray *array;
    int name_count;
    OstVtkName *name;
} OstVtkGrid;

/* Local. Read a file into an empty grid; clear it even after a failure. */
OstStatus ost_vtk_legacy_grid(OstMshCursor *cursor, OstVtkGrid *grid);
OstStatus ost_vtk_xml_grid(OstMshCursor *cursor, OstVtkGrid *grid);
OstStatus ost_vtk_parallel_grid(OstMshCursor *cursor, OstVtkGrid *grid); /* .pvtu: a list of .vtu */
OstStatus ost_vtk_hdf_grid(OstVtkGrid *grid);
void ost_vtk_clear(OstVtkGrid *grid);

/* Local. Begins a piece, whose points come next. Joins the points that pieces share: raises OST_INVALID_INPUT where it
 * is not clear which they are. */
OstStatus ost_vtk_begin_piece(OstVtkGrid *grid, OstGlobal first_point);
OstStatus ost_vtk_join_pieces(OstVtkGrid *grid);

/* Local. Is it a name of point arrays that number points over all pieces? */
int ost_vtk_numbers_points(const char *name);

/* Local. Names of cell arrays that may say which region a cell is in, from 0; NULL after the last. */
const char *ost_vtk_region_name(int number);

/* Name of the cell array in which VTK marks cells that are hidden, or another piece's. */
extern const char ost_vtk_ghosts[];

/* Local. Is an array of this name kept? Adds one, with its values, which the grid then owns. */
int ost_vtk_wants(const OstVtkGrid *grid, const char *name, int is_whole, OstGlobal components);
OstStatus ost_vtk_add_array(OstVtkGrid *grid, const char *name, int on_points, int components, OstGlobal tuples,
                            double **values);

/* Local. Did meshio write the file that the cursor is at the beginning of? The array with the sets of cells or points
 * of such a file, or NULL; `sign` stands between their names. Names the groups of cells by it; makes sets of nodes. */
int ost_vtk_is_by_meshio(const OstMshCursor *cursor);
const OstVtkArray *ost_vtk_sets(const OstVtkGrid *grid, int on_points, char *sign);
OstStatus ost_vtk_name_sets(const OstVtkGrid *grid, const OstVtkArray *array, char sign, OstCells *cells);
OstStatus ost_vtk_take_point_sets(const OstVtkGrid *grid, OstCells *cells);

/* VTK's types of numbers. */
typedef enum { OST_VTK_SIGNED, OST_VTK_UNSIGNED, OST_VTK_FLOAT } OstVtkNumberKind;
typedef struct OstVtkType {
    OstVtkNumberKind kind;
    int bytes;
} OstVtkType;

/* Local. The number at `bytes`, of which the order may be turned. */
double ost_vtk_number(OstVtkType type, int swapped, const char *bytes);

/* Local. Whole numbers of `values` in place of it, within 0 and `largest`. */
OstStatus ost_vtk_whole(OstMshCursor *cursor, const char *what, OstGlobal count, const double *values,
                        OstGlobal largest, OstGlobal *numbers);

#endif

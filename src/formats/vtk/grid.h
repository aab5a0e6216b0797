/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTK_GRID_H
#define ORTHOSTAT_FORMATS_VTK_GRID_H

#include "formats/msh/cursor.h"
#include "formats/serial/formats.h"

/* VTK's files of other programs, .vtk and .vtu: an unstructured grid in memory. */

enum { OST_VTK_NAME = 128 };

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
    const char *wanted; /* a field's name; NULL: arrays that may say which region a cell is in */
    OstGlobal points, cells;
    double *coordinates;
    OstGlobal *end; /* of each cell in the connectivity */
    OstGlobal connections;
    OstGlobal *connectivity;
    unsigned char *type;
    int array_count;
    OstVtkArray *array;
    int name_count;
    OstVtkName *name;
} OstVtkGrid;

/* Local. Read a file into an empty grid; clear it even after a failure. */
OstStatus ost_vtk_legacy_grid(OstMshCursor *cursor, OstVtkGrid *grid);
OstStatus ost_vtk_xml_grid(OstMshCursor *cursor, OstVtkGrid *grid);
void ost_vtk_clear(OstVtkGrid *grid);

/* Local. Is an array of this name kept? Adds one, with its values, which the grid then owns. */
int ost_vtk_wants(const OstVtkGrid *grid, const char *name);
OstStatus ost_vtk_add_array(OstVtkGrid *grid, const char *name, int on_points, int components, OstGlobal tuples,
                            double **values);

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

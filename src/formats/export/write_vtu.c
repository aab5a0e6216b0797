/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/export/export.h"

#include <inttypes.h>

/* VTK's XML as text: tets, then the items of boundaries. The array `region` tells which is which, and a comment at the
 * head has the names that go with its numbers, which the reader takes back. */

/* VTK's type of a tet or of a boundary's items. */
static int type_of(int dimension, int nodes)
{
    static const int linear[] = {1, 3, 5, 10}, quadratic[] = {1, 21, 22, 24};
    return nodes <= dimension + 1 ? linear[dimension] : quadratic[dimension];
}

/* Within a comment two hyphens may not follow each other. */
static void write_name(FILE *file, const char *kind, int number, const char *name)
{
    fprintf(file, "%s %d: ", kind, number);
    for (; *name; name++)
        fprintf(file, "%c%s", *name, name[0] == '-' && name[1] == '-' ? " " : "");
    fputc('\n', file);
}

static void write_names(FILE *file, const OstMeshChunk *whole)
{
    static const char *const kind[] = {"point", "curve", "surface"};
    fputs("<!--\n", file);
    for (int r = 0; r < whole->regions.count; r++)
        write_name(file, "region", r + 1, whole->regions.name[r]);
    for (int b = 0; b < whole->boundary_count; b++)
        write_name(file, kind[whole->boundaries[b].dimension], whole->regions.count + b + 1, whole->boundaries[b].name);
    fputs("-->\n", file);
}

static void open_array(FILE *file, const char *type, const char *name)
{
    fprintf(file, "<DataArray type=\"%s\" Name=\"%s\" format=\"ascii\">\n", type, name);
}

static void close_array(FILE *file)
{
    fputs("</DataArray>\n", file);
}

static void write_items(FILE *file, OstGlobal count, int width, const OstGlobal *nodes)
{
    for (OstGlobal i = 0; i < count * width; i++)
        fprintf(file, "%" PRId64 "%c", nodes[i], (i + 1) % width == 0 ? '\n' : ' ');
}

/* A number for each cell: the end of its nodes in the connectivity, its type or its region. */
typedef enum { END, TYPE, REGION } Kind;

static OstGlobal write_numbers(FILE *file, Kind kind, OstGlobal count, OstGlobal end, int width, int type, int region)
{
    for (OstGlobal i = 0; i < count; i++) {
        end += width;
        fprintf(file, "%" PRId64 "\n", kind == END ? end : kind == TYPE ? type : region);
    }
    return end;
}

static void write_of_cells(FILE *file, Kind kind, const OstMeshChunk *whole)
{
    OstGlobal end = 0;
    for (OstLocal t = 0; t < whole->tet_count; t++)
        end = write_numbers(file, kind, 1, end, whole->nodes_per_tet, type_of(3, whole->nodes_per_tet),
                            whole->tet_region[t] + 1);
    for (int b = 0; b < whole->boundary_count; b++) {
        const OstBoundary *boundary = &whole->boundaries[b];
        end = write_numbers(file, kind, boundary->count, end, boundary->nodes_per_item,
                            type_of(boundary->dimension, boundary->nodes_per_item), whole->regions.count + b + 1);
    }
}

static void write_cells(FILE *file, const OstMeshChunk *whole)
{
    fputs("<Cells>\n", file);
    open_array(file, "Int64", "connectivity");
    write_items(file, whole->tet_count, whole->nodes_per_tet, whole->tet_nodes);
    for (int b = 0; b < whole->boundary_count; b++)
        write_items(file, whole->boundaries[b].count, whole->boundaries[b].nodes_per_item, whole->boundaries[b].nodes);
    close_array(file);
    open_array(file, "Int64", "offsets");
    write_of_cells(file, END, whole);
    close_array(file);
    open_array(file, "UInt8", "types");
    write_of_cells(file, TYPE, whole);
    close_array(file);
    fputs("</Cells>\n", file);
}

/* Of boundaries' items they mean nothing. */
static void write_axes(FILE *file, const OstMeshChunk *whole, OstGlobal cells)
{
    static const double along_world[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    fputs("<DataArray type=\"Float64\" Name=\"axes\" NumberOfComponents=\"9\" format=\"ascii\">\n", file);
    for (OstGlobal c = 0; c < cells; c++) {
        const double *axes = c < whole->tet_count ? whole->tet_axes + 9 * c : along_world;
        for (int k = 0; k < 9; k++)
            fprintf(file, "%.17g%c", axes[k], k == 8 ? '\n' : ' ');
    }
    close_array(file);
}

OstStatus ost_vtu_mesh_write(FILE *file, const void *content)
{
    const OstMeshChunk *whole = content;
    OstGlobal cells = whole->tet_count;
    for (int b = 0; b < whole->boundary_count; b++)
        cells += whole->boundaries[b].count;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n",
          file);
    write_names(file, whole);
    fprintf(file, "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%" PRId64 "\">\n",
            whole->node_count, cells);
    fputs("<CellData>\n", file);
    open_array(file, "Int32", "region");
    write_of_cells(file, REGION, whole);
    close_array(file);
    if (whole->tet_axes)
        write_axes(file, whole, cells);
    fputs("</CellData>\n<Points>\n", file);
    fputs("<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n", file);
    for (OstLocal n = 0; n < whole->node_count; n++)
        fprintf(file, "%.17g %.17g %.17g\n", whole->coordinates[3 * (size_t)n], whole->coordinates[3 * (size_t)n + 1],
                whole->coordinates[3 * (size_t)n + 2]);
    close_array(file);
    fputs("</Points>\n", file);
    write_cells(file, whole);
    fputs("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", file);
    return OST_SUCCESS;
}

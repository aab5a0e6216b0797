/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_FILE_H
#define ORTHOSTAT_MESH_FILE_H

#include "orthostat/material.h"
#include "orthostat/mesh.h"

OST_API_BEGIN

/* Materials that came with a mesh (.veg): for each region its material and axes; the same on every rank. count is 0
 * where the format has none. */
typedef struct OstFileMaterials {
    int count;             /* as many as regions, in their order, or 0 */
    OstMaterial *material; /* count */
    double *axes;          /* count × 9 */
} OstFileMaterials;

/* Collective. Reads a mesh by its file's ending: .msh and .msh.gz (Gmsh 1, 2.0 to 2.2, 4.0 and 4.1, ASCII and
 * binary), .veg (Vega FEM), .vtkhdf. Serial formats are read by rank 0, .vtkhdf by all ranks in parallel. Raises
 * OST_FILE_FAILED or OST_INVALID_INPUT with file:line where there is one, what was found and what was expected. Cubic
 * .veg elements are refused by name. Nodes and tets have the file's numbers as labels. Tets come in the file's order;
 * those of a .msh file in the order of their numbers, turned if all are inverted, and without the nodes that no tet
 * uses. */
OstStatus ost_mesh_file_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials);

/* Local. Is the file at `sought` one of those a mesh file consists of: itself, or included by it? */
int ost_mesh_file_reads(OstContext *ctx, const char *path, const char *sought);
void ost_file_materials_destroy(OstFileMaterials **materials);

/* Collective. Vertex numbers of a .bou file (commas or blanks, a:b ranges, # comments) as ascending ranges between
 * which some number is missing. `ranges` in memory from the context, owned by the caller. Read by rank 0, given to all.
 */
OstStatus ost_vertex_list_read(OstContext *ctx, const char *path, OstGlobal *count, OstLabelRange **ranges);

/* Collective. `width` numbers a line for each of `lines` lines (blank lines and # comments skipped), as axes.txt holds;
 * rank 0 reads and hands each rank the lines of the given labels (1-based line numbers). */
OstStatus ost_table_read(OstContext *ctx, const char *path, int width, OstGlobal lines, OstLocal count,
                         const OstGlobal *labels, double *values);

OST_API_END

#endif

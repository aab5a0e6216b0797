/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_FORMATS_H
#define ORTHOSTAT_FORMATS_SERIAL_FORMATS_H

#include "mesh/mesh_data.h"
#include "orthostat/material.h"
#include "orthostat/mesh_file.h"

/* Materials that came with a mesh (.veg): for each region its material and axes; the same on every rank. count is 0
 * where the format has none. */
typedef struct OstFileMaterials {
    int count;             /* as many as regions, in their order, or 0 */
    OstMaterial *material; /* count */
    double *axes;          /* count × 9 */
} OstFileMaterials;

/* Collective. As ost_chunk_read, with the materials that came with the mesh. */
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

#endif

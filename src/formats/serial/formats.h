/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_FORMATS_H
#define ORTHOSTAT_FORMATS_SERIAL_FORMATS_H

#include "mesh/mesh_data.h"
#include "orthostat/material.h"
#include "orthostat/mesh_file.h"

/* Materials from a mesh file (.veg): material and axes of each region; the same on every rank. count is 0 if the format
 * has none. */
typedef struct OstFileMaterials {
    int count;             /* number of regions, in their order; or 0 */
    OstMaterial *material; /* count */
    double *axes;          /* count × 9 */
} OstFileMaterials;

/* Collective. As ost_chunk_read, with the materials of the file. */
OstStatus ost_mesh_file_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials);

/* What a field says of a tet: numbers, or a direction that has no sense (a fibre), of which those of a tet's vertices
 * are turned alike. Of a field on nodes a tet takes the mean of its vertices, or what there is at each of them. */
typedef enum { OST_FIELD_OF_NUMBERS = 0, OST_FIELD_OF_DIRECTIONS = 1, OST_FIELD_AT_VERTICES = 2 } OstFieldUse;

/* Collective. Adds to the chunk that was read from the file a field, by its name, as further columns of its
 * chunk->tet_field: 1, 3, 6 or 9 numbers a tet; NAN where a .msh or Exodus file states none. On nodes are $NodeData of
 * .msh, PointData of .vtu, .vtk and .vtkhdf, nodal variables. `use`: bits. */
OstStatus ost_mesh_file_read_field(OstContext *ctx, const char *path, const char *name, unsigned use,
                                   OstMeshChunk *chunk);

/* A field as the reader of a serial format finds it, on the tets or the nodes of a chunk. */
typedef struct OstFileField {
    int found, on_nodes, width;
    int at_vertices;  /* once it is one of tets: are the values those of its vertices? */
    double misses;    /* tets with a direction that is zero at a vertex */
    double *values;   /* tets or nodes × width; or tets × 4 × width */
    char others[256]; /* names of fields that were not asked for, as far as there is room */
} OstFileField;

/* Local. Keeps such a name, of so many letters. Raises OST_INVALID_INPUT with the names there are. */
void ost_tet_field_note(OstFileField *field, const char *name, size_t length);
OstStatus ost_tet_field_raise(OstContext *ctx, const char *path, const char *name, const OstFileField *field);

/* Local. A field on nodes becomes one on tets: the mean of their vertices, or each. */
OstStatus ost_tet_field_of_nodes(const OstMeshChunk *chunk, unsigned use, OstFileField *field);

/* Local; rank 0 warns. `misses`: of all ranks. */
void ost_tet_field_warn(OstContext *ctx, const char *path, const char *name, double misses);

/* Local. Refuses a field of another number of numbers a tet; adds the columns of one to a chunk. */
OstStatus ost_tet_field_check(OstContext *ctx, const char *path, const char *name, int width);
OstStatus ost_tet_field_add(OstMeshChunk *chunk, const char *path, const char *name, const OstFileField *field);

/* Local. Is the file's name that of a format that is read? If not, raises OST_INVALID_INPUT with the way to one that
 * is. */
OstStatus ost_mesh_file_check_name(OstContext *ctx, const char *path);

/* Local. Is the file at `sought` part of a mesh file: the file itself, or one that it includes? */
int ost_mesh_file_reads(OstContext *ctx, const char *path, const char *sought);
void ost_file_materials_destroy(OstFileMaterials **materials);

/* Collective. Vertex numbers of a .bou file (commas or blanks, a:b ranges, # comments) as ascending ranges that do not
 * touch. `ranges` in memory from the context, owned by the caller. Read by rank 0 and broadcast. */
OstStatus ost_vertex_list_read(OstContext *ctx, const char *path, OstGlobal *count, OstLabelRange **ranges);

/* Collective. Reads a table of `lines` lines with `width` numbers each (blank lines and # comments are skipped). Rank 0
 * reads, and sends each rank the lines of its labels (line numbers from 1). */
OstStatus ost_table_read(OstContext *ctx, const char *path, int width, OstGlobal lines, OstLocal count,
                         const OstGlobal *labels, double *values);

/* Readers of the serial formats: local, called on one rank. They read the whole mesh. */
OstStatus ost_msh_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_msh_read_field(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                             OstFileField *field);
OstStatus ost_veg_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials);

/* Local. Is the file at `sought` this .veg file, or one that it includes? Errors in it are left to the reader. */
int ost_veg_reads(OstContext *ctx, const char *path, const char *sought);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_MESH_FORMATS_H
#define ORTHOSTAT_FORMATS_MESH_FORMATS_H

#include "formats/serial/formats.h"

/* A format of mesh files, found by the ending of their names. Readers of serial ones are called on rank 0. */
typedef struct OstMeshFormat {
    const char *ending;
    int parallel; /* .vtkhdf, which all ranks read; the rest is for those of other programs */
    OstStatus (*read)(OstContext *ctx, const char *path, OstMeshChunk **chunk);
    OstStatus (*read_with_materials)(OstContext *ctx, const char *path, OstMeshChunk **chunk,
                                     OstFileMaterials **materials); /* instead; or NULL */
    OstStatus (*read_field)(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                            OstFileField *field); /* NULL: files have no fields that are read */
} OstMeshFormat;
extern const OstMeshFormat ost_mesh_formats[];
extern const int ost_mesh_format_count;

/* Local. What to do with a file whose ending is none of those: what it is, and the command that converts it. */
void ost_mesh_format_advice(const char *path, char *text, size_t size);

#endif

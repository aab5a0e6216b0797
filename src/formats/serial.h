/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_H
#define ORTHOSTAT_FORMATS_SERIAL_H

#include "orthostat/mesh_file.h"

/* Readers of the serial formats: local, called by the one rank that reads. They give the whole mesh. */
OstStatus ost_gmsh_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_veg_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_EXCHANGE_H
#define ORTHOSTAT_FORMATS_EXCHANGE_EXCHANGE_H

#include "mesh/mesh_data.h"

/* Readers of other programs' meshes: local, called on one rank. They read the whole mesh. */
OstStatus ost_abaqus_read(OstContext *ctx, const char *path, OstMeshChunk **chunk); /* .inp: also CalculiX */
OstStatus ost_medit_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);  /* .mesh and .meshb */
OstStatus ost_nastran_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_unv_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_tetgen_read(OstContext *ctx, const char *path, OstMeshChunk **chunk); /* .node or .ele of a pair */

#endif

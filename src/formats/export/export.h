/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXPORT_EXPORT_H
#define ORTHOSTAT_FORMATS_EXPORT_EXPORT_H

#include "mesh/mesh_data.h"

#include <stdio.h>

/* Collective. Writes a mesh with its labels, regions and boundaries in the format of the file's ending: .msh
 * (Gmsh 4.1), .inp (Abaqus), .vtu (VTK; nodes and tets numbered from 1), .vtkhdf. Raises OST_INVALID_USAGE for another
 * one. All but the last are written by rank 0, which then holds the whole mesh. */
OstStatus ost_mesh_export(const OstMesh *mesh, const char *path);

/* Local. Is a mesh written to a file of this name? Raises OST_INVALID_USAGE if not. */
OstStatus ost_mesh_export_check(OstContext *ctx, const char *path);

/* Collective. The whole mesh on rank 0, an empty chunk on the others: nodes and tets in the order of their labels. */
OstStatus ost_mesh_gather(const OstMesh *mesh, OstMeshChunk **whole);

/* Local. Write a whole mesh. */
OstStatus ost_msh_write(FILE *file, const void *whole);
OstStatus ost_abaqus_write(FILE *file, const void *whole);
OstStatus ost_vtu_mesh_write(FILE *file, const void *whole);

#endif

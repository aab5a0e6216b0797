/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTK_VTK_H
#define ORTHOSTAT_FORMATS_VTK_VTK_H

#include "formats/serial/formats.h"

/* Collective. Is it a VTKHDF file of another program that holds other cells than tets, for the readers below? */
OstStatus ost_vtk_hdf_has_others(OstContext *ctx, const char *path, int *others);

/* Local, on one rank. The whole mesh of a .vtk or .vtu file, or such a .vtkhdf file, points and cells numbered from 1
 * as they come; and a field of such a file on the tets or nodes of the chunk that was read from it. */
OstStatus ost_vtk_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_vtk_read_field(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                             OstFileField *field);

#endif

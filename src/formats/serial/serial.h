/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_SERIAL_H
#define ORTHOSTAT_FORMATS_SERIAL_SERIAL_H

#include "formats/serial/formats.h"

/* Readers of the serial formats: local, called on one rank. They read the whole mesh. */
OstStatus ost_msh_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_veg_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials);

/* Local. Is the file at `sought` this .veg file, or one that it includes? Errors in it are left to the reader. */
int ost_veg_reads(OstContext *ctx, const char *path, const char *sought);

#endif

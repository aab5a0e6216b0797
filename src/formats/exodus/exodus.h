/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXODUS_EXODUS_H
#define ORTHOSTAT_FORMATS_EXODUS_EXODUS_H

#include "formats/serial/formats.h"

/* Exodus II, of Sandia's programs, Cubit, MOOSE: local, called on one rank. Reads the whole mesh; a field of the last
 * time step. */
OstStatus ost_exodus_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);
OstStatus ost_exodus_read_field(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                                OstFileField *field);

#endif

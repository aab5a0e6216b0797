/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_CHUNK_SHARE_H
#define ORTHOSTAT_FORMATS_CHUNK_SHARE_H

#include "orthostat/mesh_file.h"

/* Collective. Rank 0 brings a chunk that is the whole mesh; the others get an empty one that agrees with it: the same
 * global counts, regions and boundaries, and no nodes, tets or items. */
OstStatus ost_chunk_share(OstContext *ctx, OstMeshChunk **chunk);

/* Collective. Gives rank 0's materials to all. */
OstStatus ost_file_materials_share(OstContext *ctx, OstFileMaterials **materials);

/* Local. A copy of `text` at the end of a list of names; the second one with a number behind it (text-2) if the list
 * has that name already. */
OstStatus ost_names_add(OstContext *ctx, OstNames *names, const char *text);
OstStatus ost_names_add_unique(OstContext *ctx, OstNames *names, const char *text);

#endif

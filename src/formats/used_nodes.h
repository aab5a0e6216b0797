/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_USED_NODES_H
#define ORTHOSTAT_FORMATS_USED_NODES_H

#include "orthostat/mesh.h"

/* Local. Leaves out the nodes of a whole mesh that no tet uses, with the items of boundaries on them, and says so. */
OstStatus ost_nodes_leave_out(OstMeshChunk *chunk, const char *path);

#endif

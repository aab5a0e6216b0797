/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_INCIDENCE_H
#define ORTHOSTAT_MESH_INCIDENCE_H

#include "orthostat/context.h"

/* The tets of each node: tet[start[n]] .. tet[start[n + 1] - 1], ascending. */
typedef struct Incidence {
    OstGlobal *start;
    OstLocal *tet;
} Incidence;

/* Local. Of the nodes below node_count; other nodes of the tets are skipped. Start from {0}; clear it also after a
 * failure. */
OstStatus ost_incidence_build(OstContext *ctx, OstLocal node_count, OstLocal tet_count, int nodes_per_tet,
                              const OstLocal *tet_nodes, Incidence *incidence);
void ost_incidence_clear(Incidence *incidence);

#endif

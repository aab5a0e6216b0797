/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_EDGE_TABLE_H
#define ORTHOSTAT_MESH_REFINEMENT_EDGE_TABLE_H

#include "mesh/mesh_data.h"

/* The edges between vertices of this rank's tets, ghosts included. An edge is listed at its low end, the vertex with
 * the lower global number; the owner of that vertex owns the edge, and has all tets around it. Owned edges come first.
 */
typedef struct EdgeTable {
    OstLocal count;
    OstLocal *start;  /* node_count + 1: the edges of low end n start at start[n] */
    OstLocal *low;    /* count: low end */
    OstLocal *high;   /* count: high end, ascending among the edges of a low end */
    OstLocal *of_tet; /* tet_count × 6, in the order of ost_tet_edge */
} EdgeTable;

/* Local. Start from {0}; clear it also after a failure. */
OstStatus ost_edge_table_build(const OstMesh *mesh, EdgeTable *table);
void ost_edge_table_clear(EdgeTable *table);

/* Local. The edge between two local nodes, or -1. */
OstLocal ost_edge_find(const EdgeTable *table, const OstMesh *mesh, OstLocal a, OstLocal b);

#endif

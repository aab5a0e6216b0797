/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_EDGE_TABLE_H
#define ORTHOSTAT_MESH_REFINEMENT_EDGE_TABLE_H

#include "mesh/mesh_data.h"

/* The edges of the tets held here, between vertices. An edge is filed under its end with the lowest global number, and
 * owned where that end is: there, all tets around it are held. Owned edges come first, as their ends do. */
typedef struct EdgeTable {
    OstLocal count;
    OstLocal *start;  /* node_count + 1: edges filed under a node */
    OstLocal *low;    /* count: the end it is filed under */
    OstLocal *high;   /* count: the other end, ascending within a node's edges */
    OstLocal *of_tet; /* tet_count × 6, in the order of ost_tet_edge */
} EdgeTable;

/* Local. Start from {0}; clear it also after a failure. */
OstStatus ost_edge_table_build(const OstMesh *mesh, EdgeTable *table);
void ost_edge_table_clear(EdgeTable *table);

/* Local. The edge between two nodes held here, or -1. */
OstLocal ost_edge_find(const EdgeTable *table, const OstMesh *mesh, OstLocal a, OstLocal b);

#endif

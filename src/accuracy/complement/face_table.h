/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_COMPLEMENT_FACE_TABLE_H
#define ORTHOSTAT_ACCURACY_COMPLEMENT_FACE_TABLE_H

#include "mesh/refinement/mid_nodes.h"

/* The faces between vertices of this rank's tets, ghosts included. A face is listed at the edge between its vertices of
 * the two lowest global numbers, and belongs to that edge's owner. */
typedef struct FaceTable {
    OstLocal count;
    OstLocal *start;  /* one more than there are edges */
    OstLocal *high;   /* count: the third vertex */
    OstLocal *of_tet; /* 4 × tet_count, in the order of ost_tet_face */
} FaceTable;

/* Local. Start from {0}; clear it also after a failure. */
OstStatus ost_face_table_build(const OstMesh *mesh, const EdgeTable *edges, FaceTable *table);
void ost_face_table_clear(FaceTable *table);

/* Local. Three of the nodes by ascending global number. */
void ost_face_sort(const OstMesh *mesh, const OstLocal *nodes, const int corner[3], OstLocal sorted[3]);

/* Local. The face at an edge with this third vertex, or -1. */
OstLocal ost_face_find(const FaceTable *table, OstLocal edge, OstLocal high);

#endif

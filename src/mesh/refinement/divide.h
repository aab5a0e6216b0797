/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_DIVIDE_H
#define ORTHOSTAT_MESH_REFINEMENT_DIVIDE_H

#include "mesh/refinement/mid_nodes.h"

/* What one tet, face, curve or point becomes: node j of child k is the parent's node[k × nodes + j], in the order of
 * quadratic items (vertices, then mid-edges). */
typedef struct Pattern {
    int children, nodes;
    const int *node;
} Pattern;

typedef struct Division {
    Pattern tet;
    Pattern item[3]; /* by dimension */
} Division;

/* The three orders of a tet's ten nodes that keep its orientation and bring each of the pairs of opposite edges to the
 * places of 02 and 13: 02 and 13 themselves, 01 and 23, 03 and 12. */
extern const int ost_tet_turn[3][10];

/* Collective. The mesh that a division makes, over the new nodes. `turn` (NULL: none) gives the order in which each tet
 * here is divided. Child k of the tet labelled p has label children (p - 1) + k + 1. `origin`, unless NULL, receives an
 * array of the caller's to free: where tet t comes from, as its parent's local number × children + k. */
OstStatus ost_mesh_divide(const MidNodes *mid, const Division *division, const unsigned char *turn, OstMesh **mesh,
                          OstLocal **origin);

#endif

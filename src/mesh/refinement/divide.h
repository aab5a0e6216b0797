/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_DIVIDE_H
#define ORTHOSTAT_MESH_REFINEMENT_DIVIDE_H

#include "mesh/refinement/mid_nodes.h"

/* The children of one tet, face, curve or point: node j of child k is the parent's node[k × nodes + j], with the
 * parent's nodes in quadratic order (vertices, then mid-edge nodes). */
typedef struct Pattern {
    int children, nodes;
    const int *node;
} Pattern;

typedef struct Division {
    Pattern tet;
    Pattern item[3]; /* by dimension */
} Division;

/* Three orders of a tet's ten nodes that keep its orientation. They bring each pair of opposite edges to the position
 * of 02 and 13: 02 and 13 themselves, 01 and 23, 03 and 12. */
extern const int ost_tet_turn[3][10];

/* Collective. Divides every tet of mid->mesh. `turn` (NULL: all 0) selects each local tet's order in ost_tet_turn.
 * Child k of the tet labelled p has label children (p - 1) + k + 1. `origin`, unless NULL, receives an array that the
 * caller frees: tet t is child k of the local tet p with origin[t] = p × children + k. */
OstStatus ost_mesh_divide(const MidNodes *mid, const Division *division, const unsigned char *turn, OstMesh **mesh,
                          OstLocal **origin);

#endif

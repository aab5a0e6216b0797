/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_BISECTION_TAG_H
#define ORTHOSTAT_MESH_BISECTION_TAG_H

#include "orthostat/mesh.h"

/* How a tet is to be bisected, and its descendants after it: the marked tets of D. N. Arnold, A. Mukherjee and
 * L. Pouly, Locally adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22 (2000) 431-448. Each face has a
 * marked edge, the same from both of its tets, and the tet is cut across an edge that both of its faces there have
 * marked. Then any choice of tets can be bisected, bisecting on until the tets meet in whole faces ends, and the
 * descendants of a tet have a bounded number of shapes. Edges are 0-5 as in ost_tet_edge. */
typedef struct OstTag {
    unsigned char edge;    /* that is cut */
    unsigned char face[4]; /* marked edge of the face opposite each vertex */
    unsigned char flag;    /* set in the children of a tet without it whose marked edges lie in one plane */
} OstTag;

/* Local. The tag of a tet of the first mesh, whose edges are ranked from long to short: rank[e] is less for longer
 * ones, and no two are the same. */
OstTag ost_tag_first(const int rank[6]);

/* Local. The tags of the two children: child c keeps end c of the cut edge (ost_tet_edge[edge][c]) and has the new
 * vertex in place of the other. */
void ost_tag_children(const OstTag *parent, OstTag child[2]);

#endif

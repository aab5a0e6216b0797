/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_TET_H
#define ORTHOSTAT_MESH_TET_H

/* Vertices of the face opposite each vertex, seen counter-clockwise from outside; and the ends of the edges, in the
 * order of the mid-edge nodes 4-9. */
extern const int ost_tet_face[4][3];
extern const int ost_tet_edge[6][2];

/* The mid-edge node (4-9) between two different vertices. */
int ost_tet_mid_node(int a, int b);

#endif

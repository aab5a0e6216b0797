/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_TET10_H
#define ORTHOSTAT_ELEMENT_TET10_H

#include "element/element.h"

/* The quadratic tet: vertices 0-3, then the middles of the edges 01 12 02 03 13 23. Its edges may be curved; where they
 * are straight, the shape functions' gradients are linear in it. Shape functions in barycentric coordinates L: vertices
 * L_a (2 L_a - 1), edges 4 L_a L_b. */
extern const OstElement ost_tet10;

/* The vertices of an edge node; of a vertex, itself twice. */
extern const int ost_tet10_ends[10][2];

/* Local. The stiffness, exactly, of tets with straight edges and one C (an upper triangle) in each: its blocks are
 * combinations of those of the linear tets on the same vertices. */
void ost_tet10_straight_blocks(const OstLanes *x, const OstLanes *c, OstLanes *blocks);

#endif

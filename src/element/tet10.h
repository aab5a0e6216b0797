/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_TET10_H
#define ORTHOSTAT_ELEMENT_TET10_H

#include "element/element.h"

/* The quadratic tet: vertices 0-3, then the middles of the edges 01 12 02 03 13 23. Edges may be curved; if they are
 * straight, the gradients of the shape functions are linear. Shape functions in barycentric coordinates L: L_a (2 L_a -
 * 1) for a vertex, 4 L_a L_b for an edge. */
extern const OstElement ost_tet10;

/* The two vertices of a mid-edge node; a vertex twice for itself. */
extern const int ost_tet10_ends[10][2];

/* Local. The stiffness of tets with straight edges and a uniform C (an upper triangle), without quadrature: its blocks
 * are linear combinations of the blocks of the linear tets on the same vertices. */
void ost_tet10_straight_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_TETS_H
#define ORTHOSTAT_ELEMENT_TETS_H

#include "element/element.h"

/* The linear tet: its strain and stress are uniform. */
extern const OstElement ost_tet4;

/* Local. Gradients of the four shape functions (3 numbers each); returns the volume, signed. */
double ost_tet4_gradients(const double x[12], double gradients[12]);

/* Local. The stiffness with a symmetric matrix C (an upper triangle), which need not be definite. */
void ost_tet4_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks);

/* The quadratic tet: vertices 0-3, then the middles of the edges 01 12 02 03 13 23. Edges may be curved; if they are
 * straight, the gradients of the shape functions are linear. Shape functions in barycentric coordinates L: L_a (2 L_a -
 * 1) for a vertex, 4 L_a L_b for an edge. */
extern const OstElement ost_tet10;

/* The two vertices of a mid-edge node; a vertex twice for itself. */
extern const int ost_tet10_ends[10][2];

/* The share of a node in the mean over a tet of what is quadratic in it, and known at the nodes. */
static inline double ost_tet10_share(int node)
{
    return node < 4 ? -0.05 : 0.2;
}

/* Local. By how much the sum of stresses at points of a tet, each times its weight, is larger along the material axes
 * there than along the tet's own: of the rule's points, x, 3 numbers each. */
void ost_vary_axes(const OstMaterialField *field, OstLocal tet, const OstQuadrature *rule, const double *weight,
                   const double *x, const double *stress, double more[6]);

/* Local. The stiffness of tets with straight edges and a uniform C (an upper triangle), without quadrature: its blocks
 * are linear combinations of the blocks of the linear tets on the same vertices. */
void ost_tet10_straight_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks);

/* Local. Of the same tets, but for those of a mixed form, the forces, and the means, of which `stiff` is to be given.
 * Where C is split, the forces lack those of the stiff mode. */
void ost_tet10_straight_force(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force);
void ost_tet10_straight_means(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstMeans *means);

#endif

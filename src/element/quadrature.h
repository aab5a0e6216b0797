/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_QUADRATURE_H
#define ORTHOSTAT_ELEMENT_QUADRATURE_H

/* Points of a tet or a triangle in barycentric coordinates; the weights add up to 1. */
typedef struct OstQuadraturePoint {
    double at[4]; /* triangle: the first three */
    double weight;
} OstQuadraturePoint;

typedef struct OstQuadrature {
    int count;
    const OstQuadraturePoint *point;
} OstQuadrature;

/* Rules for tets. All points are inside and all weights positive, so that a sum of semidefinite matrices stays so.
 * Degree 1: the centroid. Degree 2, 4 points: integrates products of two linear polynomials without error. */
extern const OstQuadrature ost_tet_degree1;
extern const OstQuadrature ost_tet_degree2;

/* Degree 3, 8 points (F. D. Witherden and P. E. Vincent, On the identification of symmetric quadrature rules for finite
 * element methods, 2015). */
extern const OstQuadrature ost_tet_degree3;

/* Degree 5, 14 points (N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000). */
extern const OstQuadrature ost_tet_degree5;

/* The vertices of a tet and the middles of its edges, in the mesh's order; they have no weights. */
extern const OstQuadrature ost_tet_nodes;

/* Rule for triangles. Degree 5, 7 points (J. Radon, Zur mechanischen Kubatur, 1948), inside, weights positive. */
extern const OstQuadrature ost_triangle_degree5;

#endif

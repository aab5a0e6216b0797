/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_STRAIGHT_H
#define ORTHOSTAT_ACCURACY_STRAIGHT_H

#include "accuracy/complement/complement.h"

/* Quadratic tets with straight edges, by linear theory: gradients of barycentric coordinates are constants there, and
 * strains are polynomials of degree 2. Curved ones are taken for straight, but for what a linear displacement needs,
 * which has a uniform strain in them too: good enough for the stiffness, not for the forces of a state. */

/* Local. Is each tet of the batch straight? x: 10 nodes. */
int ost_straight_all(const OstSimd *x);

/* Local. Forces of a displacement u of the nodes, and w of the functions, which are taken in the edges' own order; w
 * may be NULL. `rule` has the points of C if it varies: those of ost_tet_degree5. */
void ost_straight_forces(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule, const OstSimd *u,
                         const OstSimd *w, OstSimd *at_nodes, OstSimd *at_functions);

/* How the place in curved tets depends on three coordinates, at a point of ost_tet_degree5. */
typedef struct OstCurvedPoint {
    OstSimd inverse[9], volume; /* of the derivatives; that is the point's */
} OstCurvedPoint;

/* Local. Those of a batch, which all its displacements share. */
void ost_curved_points(const OstSimd *x, OstCurvedPoint at[OST_MAX_POINTS]);

/* Local. Forces of a displacement u of the nodes on the functions, and the work of all its forces on it, in the true
 * shape of curved tets. If C varies, it is given at the points of ost_tet_degree5. */
void ost_curved_forces(const OstSimd *x, const OstCurvedPoint *at, const OstElasticity *elasticity, const OstSimd *u,
                       OstSimd *at_functions, OstSimd *work);

/* Local. The stretch tensor of linear or quadratic tets, which may be curved, at the points of a rule, where only the
 * axes' line is known (elasticity->about_line). */
void ost_straight_stretches(int nodes, const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule,
                            OstSimd tensor[OST_MAX_POINTS][6]);

/* Local. The functions' own 3×3 blocks of the stiffness with a uniform C. */
void ost_straight_blocks(const OstSimd *x, const OstElasticity *elasticity, OstSimd block[OST_MAX_FUNCTIONS][9]);

#endif

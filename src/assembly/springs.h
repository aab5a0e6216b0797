/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SPRINGS_H
#define ORTHOSTAT_ASSEMBLY_SPRINGS_H

#include "assembly/supports.h"

/* Springs between nodes and the ground: a symmetric 3×3 stiffness S at each node that has one. Their force on the body
 * is -S u and keeps its directions, however far the body moves. Springs are part of the supports (OstSupports.spring),
 * and complete after ost_supports_complete. */

/* The stiffness of a spring, or of an area: `along` a direction and `across` it. */
typedef struct OstSpringStiffness {
    double along, across;
    double direction[3]; /* unit; zero: that of the surface's normal, if `across` differs */
} OstSpringStiffness;

/* Local. Makes room for springs, without any so far; all ranks do so, or none. */
OstStatus ost_supports_allow_springs(OstSupports *supports);

/* Local. Adds a spring (force per length) at an owned node. */
void ost_supports_add_spring(OstSupports *supports, OstLocal node, const OstSpringStiffness *stiffness);

/* Local. Adds an elastic foundation (force per length and area) on faces, as assembly/loads.h lists them. It is
 * integrated at the vertices of linear faces and the mid-edge nodes of quadratic ones, where these rules have degree 1
 * and 2. So it converges as fast as the elements, couples no nodes, and makes no waves where the foundation is stiff
 * (J. C. J. Schellekens and R. de Borst, On the numerical integration of interface elements, 1993). */
OstStatus ost_supports_add_foundation(OstSupports *supports, OstLocal face_count, const OstLocal *faces,
                                      int nodes_per_face, const OstSpringStiffness *stiffness);

/* What foundations add at a node along the normals of its faces, beyond what they add in every direction. */
typedef struct OstBed {
    double block[9]; /* stiffness, part of OstSupports.spring */
    int sides;
    struct {
        double stiffness;
        double normal[3]; /* weighted sum of its faces' normals, along that of the surface */
    } side[3];            /* smooth pieces of the surface, which meet in edges */
} OstBed;

/* Local. The directions in which springs hold a node, in `held->direction`, leaving out the node's OstBed. */
OstStatus ost_spring_directions(const OstSupports *supports, OstLocal node, OstSupport *held);

/* Local. How the node's OstBed holds it: `facets` has the directions held by the faces as the mesh has them, `smooth`
 * those held if the surface is smooth there. Rows, whose squared lengths sum up to 1, or to 0 where there is none. */
OstStatus ost_bed_directions(const OstSupports *supports, OstLocal node, double facets[9], double smooth[9]);

/* Local. Adds scale × the springs' forces on the body, -S u, to the owned nodes' forces. */
void ost_spring_force(const OstSupports *supports, double scale, const double *u, double *force);

/* Local. Energy of the springs at this rank's owned nodes. */
double ost_spring_energy(const OstSupports *supports, const double *u);

/* Local. The springs of a quadratic mesh on the vertices: each vertex takes half of those of its edges' nodes. */
OstStatus ost_springs_on_vertices(const OstSupports *quadratic, const OstLocal *node_of_vertex, OstSupports *linear);

#endif

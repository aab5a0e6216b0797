/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_FOLLOWER_H
#define ORTHOSTAT_ASSEMBLY_FOLLOWER_H

#include "assembly/system.h"

/* Pressure that follows the surface: -p n da of the faces as the displacement u has moved them (u may be NULL: as they
 * are undeformed). On linear and quadratic faces these forces are polynomials in the nodes' places, integrated without
 * error; over a closed surface they and their moments add up to zero in any shape. */
typedef struct OstFollower {
    const OstMesh *mesh;
    int nodes_per_face;
    OstLocal count;   /* of faces */
    OstLocal *faces;  /* count × nodes_per_face local nodes, outward, as assembly/loads.h lists them */
    double *pressure; /* of each face; positive pushes inwards */
} OstFollower;

/* Local. Adds faces under one pressure; *follower is NULL before the first. */
OstStatus ost_follower_add(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                           double pressure, OstFollower **follower);
void ost_follower_destroy(OstFollower **follower);

/* Local. Adds t times the forces to the owned nodes' `force`. */
void ost_follower_force(const OstFollower *follower, double t, const double *u, double *force);

/* Local. t times the work function -sum of p V over this rank's own faces, V the volume of the cone from the origin to
 * the face, less that before: over all ranks its gradient is the force where the surface is closed, or its rim is held;
 * elsewhere no function has that gradient. */
double ost_follower_work(const OstFollower *follower, double t, const double *u);

/* Local. Adds the symmetric part of the load stiffness, -t d force / d u, to the filled matrix, before the supports are
 * applied. The rest is an integral over the rim of the surface alone, so that it vanishes where the work function
 * exists (K. Schweizerhof and E. Ramm, Displacement dependent pressure loads in nonlinear finite element analyses,
 * 1984). */
void ost_follower_stiffen(const OstFollower *follower, double t, const double *u, OstSystem *system);

#endif

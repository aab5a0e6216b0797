/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_FOLLOWER_H
#define ORTHOSTAT_ASSEMBLY_FOLLOWER_H

#include "assembly/system.h"

/* Pressure that follows the surface: -p n da of the faces as the displacement u has moved them (u may be NULL: as they
 * are undeformed). On linear and quadratic faces these forces are polynomials in the nodes' places, integrated without
 * error; over a closed surface they and their moments add up to zero in any shape. A list, one item for each load. */
typedef struct OstFollower {
    const OstMesh *mesh;
    int nodes_per_face;
    OstLocal count;  /* of faces */
    OstLocal *faces; /* count × nodes_per_face local nodes, outward, as assembly/loads.h lists them */
    double pressure; /* at factor 1; positive pushes inwards */
    int function;    /* the function of time that is its factor (problem/problem.h) */
    struct OstFollower *next;
} OstFollower;

/* Local. Puts a load in front of the list; *follower is NULL before the first. */
OstStatus ost_follower_add(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                           double pressure, int function, OstFollower **follower);
void ost_follower_destroy(OstFollower **follower);

/* Local. Adds factor × the forces of the loads that follow a function of time to the owned nodes' `force`. */
void ost_follower_force(const OstFollower *follower, int function, double factor, const double *u, double *force);

/* Local. factor × the work function of these loads, -p times the volume of the cone from the origin to each of this
 * rank's own faces, less that before: over all ranks its gradient is the force where the surface is closed, or all of
 * its rim is held; elsewhere no function has that gradient. */
double ost_follower_work(const OstFollower *follower, int function, double factor, const double *u);

/* Collective; every rank has a list, or none has. Is that so? Where equal pressures meet, there is no rim. */
OstStatus ost_follower_conserves(const OstFollower *follower, const OstSupports *supports, int *conserves);

/* Local. Adds the symmetric part of the load stiffness, - d force / d u, of all loads to the filled matrix, before the
 * supports are applied; `factor` has one for each function. The rest is an integral over the rim of the surface alone,
 * so that it vanishes where the work function exists (K. Schweizerhof and E. Ramm, Displacement dependent pressure
 * loads in nonlinear finite element analyses, 1984). */
void ost_follower_stiffen(const OstFollower *follower, const double *factor, const double *u, OstSystem *system);

/* Local. Adds that rest, the skew part of the load stiffness, times v (3 × node_count) to the owned nodes' `product`.
 */
void ost_follower_add_skew(const OstFollower *follower, const double *factor, const double *u, const double *v,
                           double *product);

#endif

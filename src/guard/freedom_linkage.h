/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_LINKAGE_H
#define ORTHOSTAT_GUARD_FREEDOM_LINKAGE_H

#include "guard/freedom_ties.h"

/* The components as rigid bodies and what ties them: a linkage. Components that cannot move are fixed, and their joints
 * hold their neighbours like supports; the others fall into clusters that are looked at one by one. */
typedef struct OstLinkage {
    OstContext *ctx;
    const OstComponents *components;
    const OstRigidFrame *frames;
    const OstTies *ties;
    double tolerance;      /* a motion that its ties resist by no more than this share of it is free */
    OstLocal *joint_start; /* count + 1 */
    OstLocal *joint;       /* ties of each component with others */
    double *held;          /* count × OST_ROWS: by supports and fixed neighbours */
    unsigned char *fixed;
    OstLocal *cluster; /* of each component; those of fixed components mean nothing */
    OstLocal clusters;
} OstLinkage;

/* The free motions of one cluster: vector m has six numbers for each member, in the member's own frame. */
typedef struct OstFreeMotions {
    int members, count;
    OstLocal *member; /* components, ascending */
    double *motion;   /* count × 6 members */
} OstFreeMotions;

/* A cluster of more components than this is not solved as a whole. */
enum { OST_LARGEST_LINKAGE = 100 };

/* Local. */
OstStatus ost_linkage_create(OstContext *ctx, const OstComponents *components, const OstRigidFrame *frames,
                             const OstTies *ties, double tolerance, OstLinkage **linkage);
void ost_linkage_destroy(OstLinkage **linkage);

/* Local. The other end of a component's joint. */
OstLocal ost_linkage_neighbour(const OstLinkage *linkage, const OstTie *tie, OstLocal component);

/* Local. Takes a tie's conditions on a component, as if its other end were held, into a triangle in the component's
 * frame. */
void ost_linkage_hold(const OstLinkage *linkage, const OstTie *tie, OstLocal component, double triangle[OST_ROWS]);

/* Local. The free motions of these components, all of one cluster. */
OstStatus ost_linkage_solve(const OstLinkage *linkage, int members, const OstLocal *member, OstFreeMotions *free);
void ost_free_motions_release(OstFreeMotions *free);

#endif

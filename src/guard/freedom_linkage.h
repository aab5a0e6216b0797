/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_LINKAGE_H
#define ORTHOSTAT_GUARD_FREEDOM_LINKAGE_H

#include "guard/freedom_ties.h"

/* The components as rigid bodies, with the ties between them: a linkage. Components that cannot move are fixed, and
 * their joints act on their neighbours like supports; the others form clusters, each examined alone. */
typedef struct OstLinkage {
    OstContext *ctx;
    const OstComponents *components;
    const OstRigidFrame *frames;
    const OstTies *ties;
    double tolerance;      /* a motion that its ties resist by no more than this share of it is free */
    OstLocal *joint_start; /* count + 1 */
    OstLocal *joint;       /* ties of each component with others */
    double *conditions;    /* count × OST_ROWS: of supports and fixed neighbours */
    unsigned char *fixed;
    OstLocal *cluster; /* of each component; meaningless for fixed ones */
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
OstLocal ost_linkage_neighbour(const OstTie *tie, OstLocal component);

/* Local. The place of a component among some, or -1. */
int ost_place_of(int members, const OstLocal *member, OstLocal component);

/* Local. Adds a tie's conditions on a component, as if its other end were fixed, to a triangle in the component's
 * frame. */
void ost_linkage_add_conditions(const OstLinkage *linkage, const OstTie *tie, OstLocal component,
                                double triangle[OST_ROWS]);

/* Local. The free motions of these components, all of one cluster. */
OstStatus ost_linkage_solve(const OstLinkage *linkage, int members, const OstLocal *member, OstFreeMotions *free);
void ost_free_motions_release(OstFreeMotions *free);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_TIES_H
#define ORTHOSTAT_GUARD_FREEDOM_TIES_H

#include "assembly/supports.h"
#include "guard/freedom_rows.h"
#include "mesh/components/component.h"

/* What constrains a component, or two components to each other: all conditions of one kind in one triangle
 * (freedom_rows.h). For a pair they apply to the motion of body[0] relative to body[1], in the frame of the smaller
 * one. */
typedef struct OstTie {
    OstLocal body[2]; /* components, the lower one first; body[1] is OST_TIE_SUPPORT for the supports of body[0] */
    double triangle[OST_ROWS];
} OstTie;

/* A component's supports; before ost_ties_settle_beds also how surface normals hold it, see ost_bed_directions. */
enum { OST_TIE_SUPPORT = -1, OST_TIE_SMOOTH = -2, OST_TIE_FACETS = -3 };

typedef struct OstTies {
    OstLocal count;
    OstTie *tie;     /* by body[0], then body[1] */
    int facets_hold; /* number of motions that the facets of round surfaces alone would hold */
} OstTies;

/* Local. The frame of a component: the middle and half the diagonal of its box. */
OstRigidFrame ost_frame_of_box(const double low[3], const double high[3]);

/* Local. The frame that a tie's triangle is in. */
const OstRigidFrame *ost_tie_frame(const OstRigidFrame *frames, const OstTie *tie);

/* Collective. The ties of the whole body, on every rank. */
OstStatus ost_ties_create(const OstMesh *mesh, const OstSupports *supports, const OstComponents *components,
                          const OstRigidFrame *frames, OstTies *ties);
void ost_ties_release(OstTies *ties);

/* Local. Makes conditions of supports of those along surface normals (OST_TIE_SMOOTH, OST_TIE_FACETS), but for the
 * motions that the mesh's facets resist far more than the smooth surface does: a ball turns in its bed. */
OstStatus ost_ties_settle_beds(OstContext *ctx, OstTies *ties);

#endif

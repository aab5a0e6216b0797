/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LINKS_LEVERS_H
#define ORTHOSTAT_ASSEMBLY_LINKS_LEVERS_H

#include "assembly/links/links.h"

/* Ties across a gap, whose levers turn by any angle: x = sum of share_k x_k + across n, n the unit normal of the
 * tangents t_a = sum of slope_ka x_k. What of a lever lies along the face moves with the tangents, and is in the
 * shares. All of these do nothing without levers; `links` may be NULL. */

/* Collective. Takes weights to a displacement (3 × node_count; NULL: none). */
OstStatus ost_levers_turn(OstLinks *links, const double *u);

/* Collective. Puts the ends of levers where their leaders take them; u is complete but for these, ghosts included. */
OstStatus ost_levers_put(const OstLinks *links, double *u);

/* Collective. Puts into `change` (3 × node_count, u - from elsewhere) the motion of levers' ends as it is begun. */
OstStatus ost_levers_change(const OstLinks *links, const double *from, double *change);

/* Collective. What forces (3 × owned_nodes) at their ends add to the stiffness, 36 numbers for each lever of this rank:
 * the second derivative of their work, but for its sign, by both tangents; made positive semidefinite if `definite`. */
OstStatus ost_levers_bend(const OstLinks *links, const double *u, const double *out_of_balance, int definite,
                          double *bending);

/* Local. The block of that for two leaders of a lever. */
void ost_lever_block(const OstLever *lever, const double bending[36], int k, int l, double block[9]);

/* Collective. Adds the forces that it has for a motion v (3 × node_count) to those of the owned nodes. */
OstStatus ost_levers_multiply(const OstLinks *links, const double *bending, const double *v, double *force);

#endif

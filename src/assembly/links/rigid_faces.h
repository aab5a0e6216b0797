/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LINKS_RIGID_FACES_H
#define ORTHOSTAT_ASSEMBLY_LINKS_RIGID_FACES_H

#include "assembly/links/links.h"

/* Rigid faces that turn by any angle: x = point + shift + R (X - point). A displacement of the nodes holds each face's
 * motion, which is fitted to it without a loss of digits; changes of it go along curves, R = exp(w) R0, on which faces
 * keep their shape. Weights of followers are those of the arms R (X - point). All of these do nothing without faces;
 * `links` may be NULL. Displacements are 3 × node_count, ghosts filled in what is read and in what is written. */

/* Collective, once links are complete. The faces' middles, axes and extents. */
OstStatus ost_rigid_faces_measure(OstLinks *links);

/* Collective. Takes weights and motions to a displacement (NULL: none). */
OstStatus ost_rigid_faces_turn(OstLinks *links, const double *u);

/* Collective. Puts the faces' nodes where they are after `length` times the motion that `direction` has begun at
 * `from` (NULL: undeformed). */
OstStatus ost_rigid_faces_move(const OstLinks *links, const double *from, const double *direction, double length,
                               double *to);

/* Collective. Puts into `change`, at the faces' nodes, the motion from one displacement to another as it is begun or,
 * `at_end`, goes on, divided by `step`. */
OstStatus ost_rigid_faces_change(const OstLinks *links, const double *from, const double *to, int at_end, double step,
                                 double *change);

/* Collective. The motions of a displacement (NULL: none); links->face_count. */
OstStatus ost_rigid_faces_find(const OstLinks *links, const double *u, OstRigidMotion *motion);

/* Local. Puts the faces' nodes where motions take them. */
void ost_rigid_faces_put(const OstLinks *links, const OstRigidMotion *motion, double *u);

/* Local. R (X - point) of a node of the face. */
void ost_rigid_face_arm(const OstLinks *links, const OstLink *link, double arm[3]);

/* Local. R - I, row-major; and the rotation by a vector of any length. */
void ost_rigid_motion_slope(const OstRigidMotion *motion, double slope[9]);
void ost_rigid_motion_turn_by(const double vector[3], OstRigidMotion *motion);

/* Where a part of the rotation's vector v is given, R = exp(v), the rest of v is what is unknown, and moves straight.
 * |v| is at most pi. */

/* Local. v of a motion; sets it. */
void ost_rigid_motion_vector(const OstRigidMotion *motion, double vector[3]);
void ost_rigid_motion_set_vector(const double vector[3], OstRigidMotion *motion);

/* Local. T, by which R turns where v changes: w = T dv. */
void ost_rigid_vector_turning(const double vector[3], double turning[9]);

/* Local. Makes of what forces at arms add to the stiffness (ost_add_turning), and of their moment, the second
 * derivative by v. */
void ost_rigid_face_turn_vector(const OstRigidFace *face, const double moment[3], double sum[9]);

/* Local. Adds forces to the face's owned nodes, whose sum is zero and whose moment is this, as the face is turned. */
void ost_rigid_face_add_moment(const OstLinks *links, int face, const double moment[3], double *force);

/* Local. Adds what a force f at an arm a has beyond its moment: ½ (a f' + f a') - (a·f) I, the second derivative of the
 * work f·x by rotations. */
static inline void ost_add_turning(const double arm[3], const double force[3], double factor, double sum[9])
{
    const double both = arm[0] * force[0] + arm[1] * force[1] + arm[2] * force[2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum[3 * i + j] += factor * (0.5 * (arm[i] * force[j] + force[i] * arm[j]) - (i == j ? both : 0.0));
}

#endif

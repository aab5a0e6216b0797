/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_MOTION_MOTION_H
#define ORTHOSTAT_SOLVE_MOTION_MOTION_H

#include "assembly/links/links.h"
#include "mesh/mesh_data.h"

/* The motion of the body as a whole: a screw, that of the rigid body which is nearest to it in the mean of its nodes. A
 * prediction turns the body along it, and adds the rest, turned with it: a body that only turns is so predicted
 * exactly. */

/* Local. The quaternion of the rotation nearest to F (B. K. P. Horn, Closed-form solution of absolute orientation using
 * unit quaternions, J. Opt. Soc. Am. A 4, 1987). */
OstStatus ost_nearest_rotation(OstContext *ctx, const double f[9], OstRigidMotion *motion);

/* Collective. Where a body at `from` comes to in `length` that moves by `slope` there (3 × node_count each). `whole`:
 * where it would if it only moved as a whole; may be NULL. */
OstStatus ost_motion_predict(const OstMesh *mesh, const double *from, const double *slope, double length, double *whole,
                             double *to);

/* Collective. By what slope a body has come from one displacement to another in `length`, at the end of it. */
OstStatus ost_motion_slope(const OstMesh *mesh, const double *from, const double *to, double length, double *slope);

#endif

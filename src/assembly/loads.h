/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LOADS_H
#define ORTHOSTAT_ASSEMBLY_LOADS_H

#include "material/field_data.h"
#include "mesh/mesh_data.h"

/* Every function adds to `force`, 3 numbers for each local node, complete on owned nodes (values on ghosts mean
 * nothing). Faces are given by their local nodes, outward: 3 vertices (and 3 mid-edges); a rank passes every selected
 * face that touches an owned node, so a face may be passed by several ranks and counts once. */

/* Local. The same force on each of the given nodes (owned ones are acted on). OST_EFFECT_POINT_FORCE. */
OstStatus ost_load_point_force(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const double force_each[3],
                               double *force);

/* Collective. `total` shared equally by the selected nodes of all ranks (each node counted by its owner); on quadratic
 * tets vertices and mid-edge nodes alike, so that a force is shared finer, not consistently with a traction.
 * OST_EFFECT_POINT_FORCE. */
OstStatus ost_load_shared_force(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const double total[3],
                                double *force);

/* Local. Consistent nodal forces of a uniform traction (force per area) / of a pressure (positive pushes inwards),
 * exact for the element's order. OST_EFFECT_SURFACE_LOAD. */
OstStatus ost_load_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                            const double traction[3], double *force);
OstStatus ost_load_pressure(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                            double pressure, double *force);

/* Collective. Area of the selected faces over all ranks, each counted once. */
OstStatus ost_faces_area(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                         double *area);

/* Local. Gravity: density × acceleration per volume; and a plain force per volume. OST_EFFECT_BODY_FORCE. `region`
 * restricts it to a region, -1 for all. */
OstStatus ost_load_gravity(const OstMesh *mesh, const OstMaterialField *field, int region, const double acceleration[3],
                           double *force);
OstStatus ost_load_body_force(const OstMesh *mesh, int region, const double force_per_volume[3], double *force);

#endif

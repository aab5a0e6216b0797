/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LOADS_H
#define ORTHOSTAT_ASSEMBLY_LOADS_H

#include "assembly/closed_form.h"
#include "material/field_data.h"
#include "mesh/mesh_data.h"

/* Every function adds to `force`, 3 numbers for each local node; the result is complete on owned nodes and undefined on
 * ghosts. Faces are lists of local nodes, outward: 3 vertices, and 3 mid-edge nodes on quadratic tets. A rank passes
 * every selected face that touches an owned node; a face that several ranks pass counts once. */

/* Local. The same force on each of the given nodes (ghosts are skipped). OST_EFFECT_POINT_FORCE. */
OstStatus ost_load_point_force(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const double force_each[3],
                               double *force);

/* Collective. Shares `total` equally among the selected nodes of all ranks (each counted by its owner). On quadratic
 * tets vertices and mid-edge nodes get equal shares, which is not the consistent force of a uniform traction.
 * OST_EFFECT_POINT_FORCE. */
OstStatus ost_load_shared_force(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const double total[3],
                                double *force);

/* Local. Consistent nodal forces of a uniform traction (force per area), and of a pressure (positive pushes inwards).
 * OST_EFFECT_SURFACE_LOAD. */
OstStatus ost_load_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                            const double traction[3], double *force);
OstStatus ost_load_pressure(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                            double pressure, double *force);

/* Collective. Area of the selected faces over all ranks, each counted once. */
OstStatus ost_faces_area(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                         double *area);

/* Local. Consistent nodal forces of gravity (density × acceleration per volume), and of a force per volume, in a region
 * or (-1) everywhere. OST_EFFECT_BODY_FORCE. */
OstStatus ost_load_gravity(const OstMesh *mesh, const OstMaterialField *field, int region, const double acceleration[3],
                           double *force);
OstStatus ost_load_body_force(const OstMesh *mesh, int region, const double force_per_volume[3], double *force);

/* A body that turns about an axis: the force per volume density × speed² × distance from the axis, away from it. */
typedef struct OstSpin {
    double origin[3], axis[3]; /* a point of the axis, and its direction (unit) */
    double speed;              /* radians per time */
    double density;
} OstSpin;

/* Local. As a closed form that has a force per volume alone; `spin` outlives it. */
OstClosedForm ost_spin_form(const OstSpin *spin);

/* Consistent nodal forces of loads that vary in space, by quadrature of degree 5. As in assembly/loads.h they are added
 * to `force`, and complete on owned nodes. */

/* Local. The force on a piece of a face, whose normal is as long as its area. */
typedef OstStatus (*OstTractionAt)(const void *data, const double place[3], const double area[3], double force[3]);
OstStatus ost_load_by_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                               OstTractionAt at, const void *data, double *force);

/* Local. The traction of the closed-form stress on the given faces (local nodes, outward) with their discrete normals.
 * OST_EFFECT_SURFACE_LOAD. */
OstStatus ost_load_closed_form_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces,
                                        int nodes_per_face, const OstClosedForm *solution, double *force);

/* Local. The closed form's force per volume, in a region or (-1) everywhere. OST_EFFECT_BODY_FORCE. */
OstStatus ost_load_closed_form_body_force(const OstMesh *mesh, int region, const OstClosedForm *solution,
                                          double *force);

/* Local. The centrifugal force with the materials' densities (spin->density is not used), in a region or (-1)
 * everywhere. OST_EFFECT_CENTRIFUGAL. */
OstStatus ost_load_centrifugal(const OstMesh *mesh, const OstMaterialField *field, int region, const OstSpin *spin,
                               double *force);

#endif

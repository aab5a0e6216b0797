/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_CLOSED_FORM_LOADS_H
#define ORTHOSTAT_ASSEMBLY_CLOSED_FORM_LOADS_H

#include "assembly/closed_form.h"
#include "mesh/mesh_data.h"

/* Consistent nodal forces of loads that vary in space, by quadrature of degree 5. As in assembly/loads.h they are added
 * to `force`, and complete on owned nodes. */

/* Local. The traction of the closed-form stress on the given faces (local nodes, outward) with their discrete normals.
 * OST_EFFECT_SURFACE_LOAD. */
OstStatus ost_load_closed_form_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces,
                                        int nodes_per_face, const OstClosedForm *solution, double *force);

/* Local. The closed form's force per volume, in a region or (-1) everywhere. OST_EFFECT_BODY_FORCE. */
OstStatus ost_load_closed_form_body_force(const OstMesh *mesh, int region, const OstClosedForm *solution,
                                          double *force);

#endif

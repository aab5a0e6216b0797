/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_FIELD_LOADS_H
#define ORTHOSTAT_ASSEMBLY_FIELD_LOADS_H

#include "assembly/exact.h"
#include "mesh/mesh_data.h"

/* Consistent nodal forces of loads that vary from point to point, by quadrature of degree 5; as in assembly/loads.h
 * they are added to `force` and complete on owned nodes. */

/* Local. The traction of the field's stress on the given faces (local nodes, outward), for the faces' own normal.
 * OST_EFFECT_SURFACE_LOAD. */
OstStatus ost_load_exact_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                                  const OstExactField *exact, double *force);

/* Local. The field's force per volume, in a region or (-1) everywhere. OST_EFFECT_BODY_FORCE. */
OstStatus ost_load_exact_body_force(const OstMesh *mesh, int region, const OstExactField *exact, double *force);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SPREAD_H
#define ORTHOSTAT_ASSEMBLY_SPREAD_H

#include "mesh/mesh_data.h"

/* A force and a moment, spread over faces or vertices so that the sum of what acts there is the force, and its moment
 * is the moment: the least forces, in the sum of their squares by area, that do so. They vary linearly over the
 * selection, a + b × (x - c), c its centroid. A bar's end gets the stress of beam theory, or of torsion if it is round.
 */
typedef struct OstResultant {
    double force[3], moment[3];
    int acts_at; /* does the force act at the point `at`? Else at the centroid */
    double at[3];
} OstResultant;

typedef struct OstSpread {
    double mean[3], turn[3], centre[3]; /* a, b, c: a traction, or a force on each vertex */
    double gradient[9]; /* G: of forces that are not the least, as where the selection has turned; else 0 */
} OstSpread;

/* Local. a + b × (x - c) + G (x - c) */
void ost_spread_at(const OstSpread *spread, const double place[3], double value[3]);

/* Collective. Faces and vertices are listed, and forces added, as assembly/loads.h says. Raises OST_INVALID_INPUT where
 * no forces on the selection have this moment: on one point, or on a line along the moment. */
OstStatus ost_spread_over_faces(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                                const OstResultant *resultant, OstSpread *spread);
OstStatus ost_spread_over_vertices(const OstMesh *mesh, OstLocal count, const OstLocal *nodes,
                                   const OstResultant *resultant, OstSpread *spread);

/* Local. Adds the nodal forces: consistent ones of a traction, or a force on each vertex. */
void ost_load_spread_on_faces(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                              const OstSpread *spread, double *force);
void ost_load_spread_on_vertices(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const OstSpread *spread,
                                 double *force);

#endif

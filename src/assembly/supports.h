/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SUPPORTS_H
#define ORTHOSTAT_ASSEMBLY_SUPPORTS_H

#include "effect/effect.h"
#include "mesh/mesh_data.h"

/* What each node is free to do: u = P v + g, P the orthogonal projector on its free directions, g the given part of its
 * displacement (in the range of I - P). Held components, given displacements and slides on planes of any orientation
 * are all of this form. Directions are added one by one; what repeats is checked for agreement, and refused if it
 * contradicts. */
typedef struct OstSupport {
    int held;            /* number of directions held, 1 to 3 */
    double direction[9]; /* rows: orthonormal held directions */
    double given[3];     /* displacement along each */
} OstSupport;

typedef struct OstSupports {
    OstContext *ctx;
    const OstEffects *effects; /* the scene's, by which they are worked with; NULL: none were looked for */
    const OstMesh *mesh;
    OstLocal *index; /* node_count: support of a node, or -1 */
    OstLocal count, capacity;
    OstSupport *support;
} OstSupports;

OstStatus ost_supports_create(const OstMesh *mesh, OstSupports **supports);
void ost_supports_destroy(OstSupports **supports);

/* Local. Holds an owned node's displacement along a direction (of any length but 0) to `given`. Raises
 * OST_INVALID_INPUT, naming the node by its label, if it contradicts what the node is already held to. */
OstStatus ost_supports_hold(OstSupports *supports, OstLocal node, const double direction[3], double given);

/* Collective. Once every owned node is done: gives ghosts their owners' supports. Raises OST_INVALID_INPUT if nothing
 * is held anywhere. */
OstStatus ost_supports_complete(OstSupports *supports);

/* Local. The same supports on the linear mesh of a quadratic one's vertices; node_of_vertex as ost_mesh_linear gives
 * it. */
OstStatus ost_supports_on_vertices(const OstSupports *quadratic, const OstMesh *linear, const OstLocal *node_of_vertex,
                                   OstSupports **supports);

/* Local. P (9 numbers) and g of a node; returns the number of directions held (0: P is the identity). */
int ost_supports_get(const OstSupports *supports, OstLocal node, double projector[9], double given[3]);

#endif

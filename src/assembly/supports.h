/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SUPPORTS_H
#define ORTHOSTAT_ASSEMBLY_SUPPORTS_H

#include "assembly/links/links.h"
#include "effect/effect.h"
#include "mesh/mesh_data.h"

/* Each node's constraints: u = P v + g, with P the orthogonal projector on its free directions and g the prescribed
 * part of its displacement (in the range of I - P). Constrained components, prescribed displacements and slides on
 * planes of any orientation have this form. Directions are added one by one; one that depends on earlier ones must
 * agree with them. */
typedef struct OstSupport {
    int constrained;      /* number of constrained directions, 1 to 3 */
    double direction[9];  /* rows: the constrained directions, orthonormal */
    double prescribed[3]; /* displacement along each */
} OstSupport;

typedef struct OstSupports {
    OstContext *ctx;
    const OstEffects *effects; /* the scene's; NULL: not known, all count as on */
    const OstMesh *mesh;
    OstLocal *index; /* node_count: support of a node, or -1 */
    OstLocal count, capacity;
    OstSupport *support;
    double
        *spring; /* 9 × node_count: stiffness of the springs at each node (assembly/springs.h); NULL: there are none */
    OstLinks *links;    /* nodes that follow others (assembly/links/links.h), or NULL */
    struct OstBed *bed; /* owned_nodes: what of it acts along surface normals alone; NULL: nothing on this rank */
} OstSupports;

OstStatus ost_supports_create(const OstMesh *mesh, OstSupports **supports);
void ost_supports_destroy(OstSupports **supports);

/* Local. Prescribes an owned node's displacement along a direction (of any length but 0). Raises OST_INVALID_INPUT with
 * the node's label if it contradicts the node's earlier constraints. */
OstStatus ost_supports_constrain(OstSupports *supports, OstLocal node, const double direction[3], double prescribed);

/* Collective. Call it once all owned nodes are constrained: gives ghosts their owners' supports. Raises
 * OST_INVALID_INPUT if no node of any rank is constrained and there are no springs. */
OstStatus ost_supports_complete(OstSupports *supports);

/* Collective. The same supports, but for springs (ost_springs_on_vertices), on the linear mesh of a quadratic one's
 * vertices; node_of_vertex as ost_mesh_linear gives it. NULL where links have no linear form (ost_links_on_vertices).
 */
OstStatus ost_supports_on_vertices(const OstSupports *quadratic, const OstMesh *linear, const OstLocal *node_of_vertex,
                                   OstSupports **supports);

/* Local. P (9 numbers) and g (NULL: not asked for) of a node; returns the number of constrained directions (0: P is the
 * identity). Of a node that follows others, g is its offset. */
int ost_supports_get(const OstSupports *supports, OstLocal node, double projector[9], double prescribed[3]);

/* Local. Adds `factor` times what the supports prescribe to a displacement of all local nodes. */
void ost_supports_add(const OstSupports *supports, double factor, double *u);

/* Collective. What keeps owned nodes in balance, from what is out of balance there (internal forces less loads and
 * springs), each 3 × owned_nodes: `borne` by constraints, at leaders with what followers pass on to these; `passed` on
 * by links: of a follower all, of a leader less what its followers add. What is left is the residual, at rigid faces'
 * carriers that of their rows: `residual`, or NULL. */
OstStatus ost_supports_split(const OstSupports *supports, const double *out_of_balance, double *borne, double *passed,
                             double *residual);

#endif

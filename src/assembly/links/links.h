/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LINKS_LINKS_H
#define ORTHOSTAT_ASSEMBLY_LINKS_LINKS_H

#include "mesh/mesh_data.h"

/* Nodes that follow others: u = sum of W_k v_k + g, with 3×3 weights W_k on the unknowns v_k of at most six leaders, of
 * any rank. Tied faces, periodic pairs and rigid faces have this form. Followers have no unknowns of their own; the
 * equations are T' K T v = T' (f - K g) (system.h).
 *
 * A rigid face has six unknowns, which take the rows of two of its nodes, the carriers: the point's displacement, and
 * its rotation times a length. */
enum { OST_MOST_LEADERS = 6, OST_MOST_CORNERS = 3 };

typedef struct OstLeader {
    OstGlobal number; /* of the node (mesh->node_number) */
    double weight[9];
} OstLeader;

typedef struct OstLink {
    OstLocal node;
    int count;
    OstLeader leader[OST_MOST_LEADERS];
    OstLocal slot[OST_MOST_LEADERS];    /* where the leader is in the halo's arrays */
    double place[3];                    /* where the leaders' mean is; the node itself, of a rigid face */
    int line;                           /* of the case, which states it */
    int between_meshes;                 /* a tie: the sides' meshes differ */
    int face;                           /* number of the rigid face that it is a node of; -1: none */
    int corners;                        /* of a vertex among quadratic tets, 0 if not known: the vertices that it */
    OstGlobal corner[OST_MOST_CORNERS]; /* follows where the tets are taken for linear ones, by these weights */
    double corner_weight[OST_MOST_CORNERS][9];
    OstLocal corner_slot[OST_MOST_CORNERS];
} OstLink;

/* How far a rigid face has moved: its point's displacement, and the unit quaternion of its rotation. */
typedef struct OstRigidMotion {
    double shift[3], turn[4];
} OstRigidMotion;

/* A rigid face: its point, and its motion there, prescribed or free. */
typedef struct OstRigidFace {
    double point[3], length;
    OstGlobal first;      /* the lowest of its nodes */
    OstGlobal carrier[2]; /* of the displacement, and of the rotation times `length`; -1: all of it is prescribed */
    int constrained[6];   /* displacement, rotation */
    double given[6];      /* what is prescribed of them */
    int by_vector;        /* is a part of its rotation's vector given? Else rotation is about the axes that are free */
    double middle[3];     /* the mean of its nodes, */
    double axis[9];       /* the principal axes of their places about it, as rows, the longest first, */
    double extent[3];     /* and their second moments along these */
    OstRigidMotion now;   /* that the weights have (rigid_faces.h) */
} OstRigidFace;

/* A weight on what a leader's support takes: W(I - P). */
typedef struct OstHeldWeight {
    OstLocal node; /* that follows */
    int leader;
    double weight[9];
} OstHeldWeight;

/* A tied node across a gap (levers.h): with the numbers of its leaders' places, and their supports. */
typedef struct OstLever {
    OstLocal node;
    double share[OST_MOST_LEADERS], slope[OST_MOST_LEADERS][2], across;
    double projector[OST_MOST_LEADERS][9], weight[OST_MOST_LEADERS][9]; /* weight: without the supports */
} OstLever;

/* What forces at arms add to the stiffness: 9 numbers for each rigid face, 36 for each lever of this rank. */
typedef struct OstTurning {
    double *faces, *levers;
} OstTurning;

typedef struct OstLinks {
    OstContext *ctx;
    const OstMesh *mesh;
    OstLocal count, all, capacity; /* links of owned nodes; then of ghosts, once complete */
    OstLink *link;
    OstLocal held_count;      /* of owned nodes: */
    OstHeldWeight *held;      /* on leaders that are constrained */
    const char *path;         /* of the case, or NULL */
    int line;                 /* where it states the links that are added */
    int between_meshes;       /* are these of a tie? */
    int of_face;              /* or of which rigid face? -1: none */
    OstLocal *of_node;        /* node_count: the link of a node, or -1 */
    unsigned char *leads;     /* node_count: does another follow this one? */
    unsigned char *kept;      /* owned_nodes: has the node a row though it follows? (carriers) */
    double *offset;           /* 3 × node_count: g of followers, and 0 */
    int gaps;                 /* has any rank levers? */
    int periodic;             /* are there periodic pairs? On edges of the cell leaders follow others */
    int moves;                /* is any offset not zero, on any rank? */
    struct OstHalo *halo;     /* owned nodes, and leaders of other ranks */
    struct OstHalo *of_links; /* links of owned nodes, then of ghosts */
    OstLocal lever_count;     /* of owned nodes */
    OstLever *lever;
    OstLocal slots; /* both together */
    int face_count;
    OstRigidFace *face;
} OstLinks;

OstStatus ost_links_create(const OstMesh *mesh, OstLinks **links);
void ost_links_destroy(OstLinks **links);

/* Local. Makes an owned node follow others, moved by `offset` besides. Raises OST_INVALID_INPUT with the node's label
 * if it follows others already. */
OstStatus ost_links_add(OstLinks *links, OstLocal node, int count, const OstLeader *leader, const double place[3],
                        const double offset[3]);

/* Local. How the node that was added last follows in the linear mesh. */
void ost_links_add_corners(OstLinks *links, int count, const OstGlobal *corner, const double (*weight)[9]);

/* Collective. The links of a quadratic mesh's vertices, on the linear mesh of ost_mesh_linear; not complete. NULL if
 * there are rigid faces or levers, or a vertex would follow one that itself follows others. */
OstStatus ost_links_on_vertices(const OstLinks *quadratic, const OstMesh *linear, const OstLocal *node_of_vertex,
                                OstLinks **links);

/* Local. Notes the lever of a node that has been added; its leaders are those of the link. */
OstStatus ost_links_add_lever(OstLinks *links, const OstLever *lever);

/* Local. Notes a rigid face; its carriers' rows are kept. */
OstStatus ost_links_add_face(OstLinks *links, const OstRigidFace *face);

/* Local. The weight of a face's rotation, times its length, at the end of an arm. */
void ost_rigid_face_weight(const OstRigidFace *face, const double arm[3], double weight[9]);

/* How a node is supported: u = P v + g. */
typedef struct OstHeld {
    double projector[9], prescribed[3];
    int constrained; /* number of directions */
} OstHeld;

/* Collective. Call it when all links are there: takes the supports of the owned nodes, as leaders, into weights and
 * offsets, and gives ghosts their owners' links. A follower's own supports are taken from it (constrained is 0 then)
 * where its leaders hold it at rest; raises OST_INVALID_INPUT where they do not, or a follower is followed. */
OstStatus ost_links_complete(OstLinks *links, OstHeld *held);

/* Collective. Gives ghosts the weights of their owners' links. */
OstStatus ost_links_share_weights(OstLinks *links);

/* Collective. u += W v of the owned followers, from what owned nodes have of v (`of_leaders`, 3 × links->slots, whose
 * ghosts are filled here); u has 3 numbers for each node. */
OstStatus ost_links_follow(const OstLinks *links, double *of_leaders, double *u);

/* Collective. W' f of the owned followers' forces (3 × owned_nodes), added up at their leaders: `of_leaders` has 3 ×
 * links->slots numbers, the owned nodes first. */
OstStatus ost_links_gather(const OstLinks *links, const double *force, double *of_leaders);

/* Collective. The same for W(I - P), which the leaders' supports take: nothing moves by it, but what is given at them
 * acts there. */
OstStatus ost_links_follow_held(const OstLinks *links, double *of_leaders, double *u);
OstStatus ost_links_gather_held(const OstLinks *links, const double *force, double *of_leaders);

/* Local. The link of a node, or NULL. `links` may be NULL. */
static inline const OstLink *ost_link_of(const OstLinks *links, OstLocal node)
{
    return links && links->of_node[node] >= 0 ? &links->link[links->of_node[node]] : NULL;
}

#endif

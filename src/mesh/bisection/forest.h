/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_BISECTION_FOREST_H
#define ORTHOSTAT_MESH_BISECTION_FOREST_H

#include "core/index_map.h"
#include "core/parallel/rendezvous.h"
#include "mesh/bisection/tag.h"
#include "mesh/mesh_data.h"
#include "orthostat/refine.h"

/* The bisection of a mesh, under way: each of this rank's own tets is the root of a tree, whose leaves are the tets of
 * the new mesh. Vertices are the old mesh's nodes by local number, then those of cut edges. */

typedef struct Leaf {
    OstLocal vertex[4]; /* in positive order */
    OstLocal edge[6];
    OstLocal root;  /* local tet of the old mesh */
    OstLocal place; /* row of `barycentric`; -1: the leaf is the root itself */
    int depth;      /* cuts from the root */
    uint64_t path;  /* the way from the root, the first cut in the highest bit: 1 for the second child */
    OstTag tag;
} Leaf;

/* A curve or a face of a boundary, in leaves of its own. */
typedef struct Item {
    int boundary, dimension;
    int marked; /* face: which of its edges is cut first */
    OstLocal vertex[3];
    OstLocal edge[3]; /* between vertices 01 12 20; of a curve the first */
} Item;

typedef struct ForestEdge {
    OstLocal cut;    /* the vertex in its middle, or -1 */
    char shared;     /* may other ranks have tets with it? */
    char told;       /* does the meeting place know that this rank has it? */
    char wanted;     /* is its image on the opposite boundary of a periodic pair cut? */
    OstLocal notice; /* the notice of it in this round, or -1 */
} ForestEdge;

typedef struct ForestVertex {
    OstGlobal label;
    OstLocal ends[2];        /* of the edge that it cuts; -1 for a node of the old mesh */
    int holder;              /* the rank that puts it into the new mesh; -1 for a node of the old mesh */
    char shared;             /* may other ranks have tets with it? */
    uint32_t leads, follows; /* the periodic pairs on whose boundaries it lies (mesh/periods.h) */
    OstGlobal leader;        /* the label of its image on the boundaries that lead; 0: it follows none */
    char flat;               /* is it put halfway between its ends, as tets would turn over? (flat.c) */
    double x[3];
} ForestVertex;

/* An edge to be cut, or one about whose cutting this rank wants to hear. */
typedef struct Notice {
    OstKey key;    /* its ends' labels */
    OstGlobal tet; /* label of the root that cuts it; INT64_MAX: none */
    double x[3];   /* where that puts its middle */
    OstLocal edge; /* its number on the rank that sends this */
    int first;     /* the meeting place does not know yet that this rank has the edge */
} Notice;

typedef struct Forest {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstShapeSurface *shape;
    const struct OstPeriods *periods; /* NULL: there are none */
    OstGlobal highest_label;          /* of a vertex, so far */
    OstGlobal label_limit;            /* of a node of the old mesh */
    OstLocal vertex_count;
    ForestVertex *vertex;
    OstIndex *edges; /* by the local numbers of its ends, the lower first */
    ForestEdge *edge;
    OstLocal leaf_count;
    Leaf *leaf;
    OstLocal place_count;
    double *barycentric; /* place_count × 16: of each vertex of a leaf, in its root */
    OstLocal item_count;
    Item *item;
    OstLocal notice_count;
    Notice *notice;
    struct Cuts *cuts;
} Forest;

/* Collective. The forest of a mesh's own tets with one tag for every local tet, and its boundary items. `periods` of
 * this mesh, or NULL, live until the forest has grown. */
OstStatus ost_forest_create(const OstMesh *mesh, const OstTag *tag, const OstShapeSurface *shape,
                            const struct OstPeriods *periods, Forest **forest);
void ost_forest_destroy(Forest **forest);

/* Collective. Bisects each of the rank's own tets and their children as many times as it says, and others until all
 * tets of the body meet in whole faces, and the boundaries of periodic pairs have the same ones. */
OstStatus ost_forest_grow(Forest *forest, const unsigned char *times);

/* Collective, once tets meet. Wants edges to be cut whose images are; how many more than before, on all ranks. */
OstStatus ost_forest_want_images(Forest *forest, OstGlobal *wanted);

/* Collective. Puts new vertices on boundaries that follow where their images on those that lead are, unless they are
 * there to rounding. */
OstStatus ost_forest_follow(Forest *forest);

/* Collective, once it has grown. Puts new vertices halfway between the ends of their edges where straight leaves would
 * turn over, and warns. */
OstStatus ost_forest_flatten(Forest *forest);

/* Collective. The leaves as a chunk of linear tets. The leaves are put in order: by root, then by path. `leaf_label`
 * receives the label of each, an array that the caller frees. */
OstStatus ost_forest_chunk(Forest *forest, OstMeshChunk **chunk, OstGlobal **leaf_label);

/* Local. The number of an edge, which is added if it is new. */
OstStatus ost_forest_edge(Forest *forest, OstLocal a, OstLocal b, OstLocal *edge);

/* Local. The edge's ends. */
static inline void ost_forest_ends(const Forest *forest, OstLocal edge, OstLocal ends[2])
{
    ends[0] = (OstLocal)forest->edges->key[2 * (size_t)edge];
    ends[1] = (OstLocal)forest->edges->key[2 * (size_t)edge + 1];
}

/* Local. The value at barycentric coordinates b of a field (`width` numbers a node) on a tet of the old mesh. */
void ost_forest_value(const OstMesh *mesh, OstLocal tet, const double b[4], int width, const double *field,
                      double *value);

/* Local. Barycentric coordinates of a leaf's vertex in its root. */
void ost_forest_barycentric(const Forest *forest, const Leaf *leaf, int vertex, double b[4]);

/* Local. The boundary items: filed at the start, and those cut across whose edge is cut; returns by *split how many. */
OstStatus ost_forest_file_items(Forest *forest, const OstTag *tag);
OstStatus ost_forest_split_items(Forest *forest, OstLocal *split);

/* Collective. Tells the meeting places of the noticed edges, and gives each newly cut edge of this rank its vertex. New
 * labels follow the highest one in the order of the edges' labels, whichever ranks have them. */
OstStatus ost_forest_exchange(Forest *forest);
void ost_cuts_destroy(struct Cuts **cuts);

/* Local. Room for one more entry of an array that grows. */
OstStatus ost_forest_room(OstContext *ctx, OstLocal count, size_t size, void **array);
#define FOREST_ROOM(forest, count, array) ost_forest_room((forest)->ctx, (count), sizeof **(array), (void **)(array))

#endif

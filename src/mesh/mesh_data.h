/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_MESH_DATA_H
#define ORTHOSTAT_MESH_MESH_DATA_H

#include "orthostat/mesh.h"

/* A named group of points, curves or faces. */
typedef struct OstBoundary {
    char *name;
    int dimension;      /* 0 points, 1 curves, 2 faces */
    int nodes_per_item; /* 1; 2, 3; 3, 6 */
    OstLocal count;
    OstGlobal *nodes; /* count × nodes_per_item: global numbers in a chunk, local numbers in a mesh */
} OstBoundary;

/* What plane faces do to the volume of a body whose surface is meant to be curved, as shares of it. */
typedef struct OstCutOff {
    int known;
    double lacking; /* cut off where the surface is convex */
    double filled;  /* added in hollows */
} OstCutOff;

/* Names shared by every rank. */
typedef struct OstNames {
    int count;
    char **name;
} OstNames;

/* Labels of vertices from first to last, both included; at most OST_LARGEST_LABEL. */
typedef struct OstLabelRange {
    OstGlobal first, last;
} OstLabelRange;
#define OST_LARGEST_LABEL INT64_C(999999999999999999)

/* Fields of a mesh file that somebody asked for: their columns in a table of the tets, field i from first[i] to
 * first[i + 1]. Those of a field at the vertices are four times its numbers, vertex by vertex. */
enum { OST_MOST_TET_FIELDS = 8 };
typedef struct OstTetFields {
    int count;
    int first[OST_MOST_TET_FIELDS + 1];
    char at_vertices[OST_MOST_TET_FIELDS];
} OstTetFields;

/* Columns of all of them. */
static inline int ost_tet_fields_width(const OstTetFields *fields)
{
    return fields->first[fields->count];
}

/* Local. The columns of a tet from those of its parent, in which its vertices have the barycentric coordinates `place`.
 */
void ost_tet_fields_inherit(const OstTetFields *fields, const double *parent, const double place[4][4], double *child);

/* This rank's share of a mesh before it is partitioned. Numbers are global, from 0; the ranks' ranges are contiguous. A
 * reader of a serial format gives everything to rank 0. Every rank has the same list of boundaries, in the same order,
 * with its share of their items. */
struct OstMeshChunk {
    OstContext *ctx;
    int nodes_per_tet;
    OstGlobal global_nodes, global_tets;
    OstGlobal first_node, first_tet;
    OstLocal node_count, tet_count;
    double *coordinates;   /* node_count × 3 */
    OstGlobal *node_label; /* numbers as in the file; NULL: 1, 2, 3, ... */
    OstGlobal node_shift;  /* these are so much more than in the file */
    OstGlobal *tet_nodes;  /* tet_count × nodes_per_tet */
    OstGlobal *tet_label;  /* numbers as in the file; NULL: 1, 2, 3, ... */
    int relabelled;        /* the file's numbers of tets were no use, and were replaced */
    int of_cells;          /* tets are pieces of the file's cells: those of cell 17 have the labels 171, 172, ... */
    int of_arrays;         /* of a program, which counts tets from 0 */
    int32_t *tet_region;   /* index into regions */
    double *tet_axes;      /* NULL, or tet_count × 9: rows e1 e2 e3 */
    double *tet_field;     /* NULL, or tet_count × the columns of the fields */
    OstTetFields fields;   /* the same on all ranks */
    OstNames regions;
    int boundary_count;
    OstBoundary *boundaries;
    int straighten;    /* curved tets that fold over are made straight when the mesh is distributed, not refused */
    int only_vertices; /* what is between vertices is left out afterwards: curved tets may fold over */
    OstCutOff cut_off; /* of the mesh that this one refines without its surface's shape, if it is known there */
    char *file;        /* that it is read from, for messages; or NULL */
};

/* The file's number of a tet, or of the cell that it is a piece of; and words for messages, "" where they are one.
 * A program's tets have an index too. */
enum { OST_PIECE_LABELS = 10, OST_CELL_WORDS = 64 };
static inline OstGlobal ost_cell_label(int of_cells, OstGlobal tet_label)
{
    return of_cells ? tet_label / OST_PIECE_LABELS : tet_label;
}
const char *ost_cell_words(const OstMesh *mesh, OstGlobal tet_label, char words[OST_CELL_WORDS]);

/* What the partition kept on one rank each (mesh/distribution/weld.h). */
enum { OST_WELDED_STIFF = 1, OST_WELDED_CLOSE = 2 };

/* One rank's part of the partitioned mesh: its owned nodes, every tet that touches one of them, and the other nodes of
 * those tets as ghosts. Local numbers: owned nodes first, then ghosts grouped by owner; owned tets first, then ghost
 * tets (the owner of a tet is the owner of its node with the lowest global number). Boundaries have every item that
 * touches an owned node, but points only if owned. Region and boundary names are the same on every rank. */
struct OstMesh {
    OstContext *ctx;
    int nodes_per_tet;
    OstGlobal global_nodes, global_tets;
    OstLocal node_count, owned_nodes;
    OstLocal tet_count, owned_tets;
    OstGlobal first_node;   /* global number of local node 0 after partition: owned nodes are first_node + i */
    OstGlobal *node_number; /* node_count: global numbers after partition (contiguous over ranks) */
    OstGlobal *node_label;  /* node_count: numbers as in the file, but from 1: */
    OstGlobal node_shift;   /* so much more than in a file that has lower ones */
    OstGlobal *tet_label;   /* tet_count: likewise */
    OstGlobal tet_shift;    /* a refined mesh has it no more */
    int of_cells;           /* as in the chunk; a refined mesh has it no more */
    int of_arrays;          /* likewise */
    double *coordinates;    /* node_count × 3 */
    OstLocal *tet_nodes;    /* tet_count × nodes_per_tet */
    int32_t *tet_region;    /* tet_count */
    double *tet_axes;       /* NULL, or tet_count × 9 */
    double *tet_field; /* NULL, or tet_count × the columns: as in the chunk; children inherit that of their parent */
    OstTetFields fields;
    OstNames regions;
    int boundary_count;
    OstBoundary *boundaries;
    struct OstHalo *halo;       /* over nodes */
    int straighten;             /* as in the chunk */
    unsigned welded;            /* bits of the above, the same on all ranks; a refined mesh has those of the first */
    struct OstSurface *surface; /* once it was asked for (ost_mesh_surface); or NULL */
    unsigned char *at_surface;  /* node_count, once components were found: 1 for vertices of the surface's faces that
                                   have an owned vertex; or NULL */
    OstCutOff cut_off;          /* as in the chunk, or once it was asked for (ost_mesh_cut_off) */
};

/* The file's numbers of a node and a tet, for messages. */
static inline OstGlobal ost_mesh_node_number(const OstMesh *mesh, OstLocal node)
{
    return mesh->node_label[node] - mesh->node_shift;
}
static inline OstGlobal ost_mesh_tet_number(const OstMesh *mesh, OstLocal tet)
{
    return mesh->tet_label[tet] - mesh->tet_shift;
}

/* The local numbers of a tet's nodes. */
static inline const OstLocal *ost_mesh_nodes_of(const OstMesh *mesh, OstLocal tet)
{
    return mesh->tet_nodes + (size_t)tet * (size_t)mesh->nodes_per_tet;
}

/* What the partition wants to know of the material, of each of the chunk's tets. Both are local, called with more than
 * one rank, and may be NULL. `fill`: the metric (6 numbers, 11 22 33 12 23 31, largest eigenvalue 1) from the centroids
 * (3 numbers each); stiff couplings are not cut. `stiffness`: its largest Young's modulus, or what is proportional to
 * it; stiff inclusions stay whole (mesh/distribution/weld.h). */
typedef struct OstTetMetric {
    const void *data;
    OstStatus (*fill)(const void *data, const OstMeshChunk *chunk, const double *centroids, double *metric);
    OstStatus (*stiffness)(const void *data, const OstMeshChunk *chunk, double *stiffness);
} OstTetMetric;

/* Local. Gives the chunk the node labels 1, 2, 3, ... if it has none. */
OstStatus ost_chunk_label_nodes(OstMeshChunk *chunk);

/* Collective. As ost_mesh_distribute, by what the material is (`tets` NULL: isotropic, and the same everywhere). */
OstStatus ost_mesh_distribute_by(OstContext *ctx, OstMeshChunk **chunk, const OstTetMetric *tets, OstMesh **mesh);

/* Local. Index of a name, or -1; and the names in one line for messages, ending in dots if they do not fit. */
int ost_names_find(const OstNames *names, const char *name);
void ost_names_list(const OstNames *names, char *text, size_t size);
void ost_mesh_list_boundaries(const OstMesh *mesh, char *text, size_t size);

/* Local. Does this rank own the item with these local nodes? (The owner of its lowest global number does.) */
int ost_mesh_owns(const OstMesh *mesh, int count, const OstGlobal *nodes);

/* Collective. Makes the halo from node_number; ghosts take their coordinates and labels from their owners. */
OstStatus ost_mesh_connect(OstMesh *mesh);

/* Faces of the body's surface that touch an owned node, oriented outwards: vertices, then mid-edge nodes. `tet` is the
 * tet behind each face. */
typedef struct OstSurface {
    OstLocal count;
    int nodes_per_face;
    OstLocal *nodes; /* count × nodes_per_face, local numbers */
    OstLocal *tet;
} OstSurface;

/* Collective. `marked`: a number for each node, 1 where faces between marked vertices are wanted, else 0; NULL: all. */
OstStatus ost_surface_create(const OstMesh *mesh, const unsigned char *marked, OstSurface **surface);

/* Collective. The same, made once and kept: it belongs to the mesh. */
OstStatus ost_mesh_surface(const OstMesh *mesh, const OstSurface **surface);
void ost_surface_destroy(OstSurface **surface);

/* Collective. Number of faces on the body's surface: of a mesh, exactly; of a chunk, from a sample of its faces where
 * it has more than 100,000 tets. */
OstStatus ost_mesh_surface_faces(const OstMesh *mesh, double *faces);
OstStatus ost_chunk_surface_faces(const OstMeshChunk *chunk, double *faces);

/* Collective. What plane faces cut off and add if the surface is meant to be smooth wherever they meet at less than 40
 * degrees. Of a mesh that was refined without the surface's shape: what those of the first did. */
OstStatus ost_mesh_cut_off(const OstMesh *mesh, OstCutOff *cut);

void ost_names_clear(OstNames *names);
void ost_boundaries_destroy(int count, OstBoundary **boundaries);

/* Local. Appends a copy of `text` to a list of names; ost_names_add_unique appends a number (text-2) if the list has
 * that name already. */
OstStatus ost_names_add(OstContext *ctx, OstNames *names, const char *text);
OstStatus ost_names_add_unique(OstContext *ctx, OstNames *names, const char *text);

/* Local. Is a name UTF-8 without control characters? The other makes it so: bytes that are no UTF-8 are taken as
 * Latin-1, control characters become blanks. */
int ost_name_is_plain(const char *name);
OstStatus ost_name_plain(OstContext *ctx, char **name);

/* Local. The mesh's local number of a node by its global number, or -1 if it is not on this rank. */
OstLocal ost_mesh_local(const OstMesh *mesh, OstGlobal number);

/* Vertices of the face opposite each vertex, seen counter-clockwise from outside; and the ends of the edges, in the
 * order of the mid-edge nodes 4-9. (Here, so that the compiler may unroll loops over them.) */
static const int ost_tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
static const int ost_tet_edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/* The mid-edge node (4-9) between two different vertices. */
int ost_tet_mid_node(int a, int b);

/* Barycentric coordinates of a tet's node 0-9. */
void ost_tet_node_place(int node, double place[4]);

#endif

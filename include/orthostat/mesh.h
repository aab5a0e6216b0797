/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_H
#define ORTHOSTAT_MESH_H

#include "orthostat/context.h"

OST_API_BEGIN

/* Tets have 4 or 10 nodes. Vertices 0-3 are positively oriented: (x1-x0)·((x2-x0)×(x3-x0)) > 0. The six mid-edge nodes
 * follow in VTK's order: 01 12 02 03 13 23. Faces have 3 or 6 nodes (vertices, then mid-edges 01 12 20), curves 2 or 3,
 * points 1. */

/* A named group of points, curves or faces. */
typedef struct OstBoundary {
    char *name;
    int dimension;      /* 0 points, 1 curves, 2 faces */
    int nodes_per_item; /* 1; 2, 3; 3, 6 */
    OstLocal count;
    OstGlobal *nodes; /* count × nodes_per_item: global numbers in a chunk, local numbers in a mesh */
} OstBoundary;

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

/* This rank's share of a mesh before it is partitioned. Numbers are global, from 0. Ranges are contiguous over ranks;
 * a reader of a serial format gives everything to rank 0. Boundaries are the same list, in the same order, on every
 * rank, with this rank's share of the items. */
typedef struct OstMeshChunk {
    OstContext *ctx;
    int nodes_per_tet;
    OstGlobal global_nodes, global_tets;
    OstGlobal first_node, first_tet;
    OstLocal node_count, tet_count;
    double *coordinates;   /* node_count × 3 */
    OstGlobal *node_label; /* numbers as in the file; NULL: 1, 2, 3, ... */
    OstGlobal *tet_nodes;  /* tet_count × nodes_per_tet */
    OstGlobal *tet_label;  /* numbers as in the file; NULL: 1, 2, 3, ... */
    int32_t *tet_region;   /* index into regions */
    double *tet_axes;      /* NULL, or tet_count × 9: rows e1 e2 e3 */
    OstNames regions;
    int boundary_count;
    OstBoundary *boundaries;
} OstMeshChunk;

/* One rank's piece of the partitioned mesh: its own nodes, every tet that touches one of them, and the other nodes of
 * those tets as ghosts. Local numbers: owned nodes first, then ghosts grouped by owner. Tets: those this rank owns (the
 * owner of a tet is the owner of its node with the lowest global number) first. Boundaries hold every item that touches
 * an owned node, and points only where owned; regions and boundary names are the same on every rank. */
typedef struct OstMesh {
    OstContext *ctx;
    int nodes_per_tet;
    OstGlobal global_nodes, global_tets;
    OstLocal node_count, owned_nodes;
    OstLocal tet_count, owned_tets;
    OstGlobal first_node;   /* global number of local node 0 after partition: owned nodes are first_node + i */
    OstGlobal *node_number; /* node_count: global numbers after partition (contiguous over ranks) */
    OstGlobal *node_label;  /* node_count: numbers as in the file */
    OstGlobal *tet_label;   /* tet_count */
    double *coordinates;    /* node_count × 3 */
    OstLocal *tet_nodes;    /* tet_count × nodes_per_tet */
    int32_t *tet_region;    /* tet_count */
    double *tet_axes;       /* NULL, or tet_count × 9 */
    OstNames regions;
    int boundary_count;
    OstBoundary *boundaries;
    struct OstHalo *halo; /* over nodes */
} OstMesh;

/* The tube of Li and Barbič's Fig. 6: divisions around × radial × axial hexes of six tets. Node (k, j, i), k along the
 * axis, j around, i through the wall, has label (k·around + j)·(radial + 1) + i + 1 and, for axis y, lies at (r cos θ,
 * origin_y + length k/axial, r sin θ), θ = 2πj/around. The other axes turn this cyclically. Region "tube"; boundaries
 * "bottom", "top", "ends", "inner", "outer". */
typedef struct OstTubeShape {
    int axis; /* 0 x, 1 y, 2 z */
    double origin[3];
    double length;
    double radii[2];
    OstLocal around, radial, axial;
} OstTubeShape;

/* A box origin + [0, size]: nx × ny × nz hexes of six tets. Node (a, b, c) has label (a·(ny+1) + b)·(nz+1) + c + 1.
 * Region "block"; boundaries "xmin", "xmax", "ymin", "ymax", "zmin", "zmax". */
typedef struct OstBlockShape {
    double origin[3];
    double size[3];
    OstLocal divisions[3];
} OstBlockShape;

/* A part of a tube, from 0 to `angle` degrees (less than 360) about the axis: nodes as the tube's, with around + 1 of
 * them on each arc; k, j, i has label (k·(around + 1) + j)·(radial + 1) + i + 1. Region "sector"; boundaries "bottom",
 * "top", "inner", "outer", and at 0 and `angle` "start" and "finish" (exactly in a coordinate plane where the angle is
 * a multiple of 90). */
typedef struct OstSectorShape {
    int axis; /* 0 x, 1 y, 2 z */
    double origin[3];
    double length;
    double radii[2];
    double angle;
    OstLocal around, radial, axial;
} OstSectorShape;

/* The octant x, y, z >= 0 (from its centre) of a thick sphere, in 3 × around × around × radial hexes of six tets: three
 * faces of a cube blown up, with 2 × around divisions on each quarter circle. Region "shell"; boundaries "inner",
 * "outer", and exactly in the planes of symmetry "xmin", "ymin", "zmin". */
typedef struct OstOctantShape {
    double centre[3];
    double radii[2];
    OstLocal around, radial;
} OstOctantShape;

/* Collective. Each rank makes its share only. */
OstStatus ost_chunk_create_tube(OstContext *ctx, const OstTubeShape *shape, OstMeshChunk **chunk);
OstStatus ost_chunk_create_block(OstContext *ctx, const OstBlockShape *shape, OstMeshChunk **chunk);
OstStatus ost_chunk_create_sector(OstContext *ctx, const OstSectorShape *shape, OstMeshChunk **chunk);
OstStatus ost_chunk_create_octant(OstContext *ctx, const OstOctantShape *shape, OstMeshChunk **chunk);

/* A named group of points, curves or faces in the caller's arrays. A face has 3 nodes in a mesh of linear tets and 6 in
 * one of quadratic tets, a curve 2 or 3, a point 1. */
typedef struct OstBoundaryArrays {
    const char *name;
    int dimension;          /* 0 points, 1 curves, 2 faces */
    OstLocal count;         /* of this rank's share of the items */
    const OstGlobal *nodes; /* count × nodes of an item, numbers over the whole body */
} OstBoundaryArrays;

/* A mesh as a program holds it: this rank's share of the nodes and tets. Node numbers count from 0 over the whole body:
 * rank 0's nodes come first, then rank 1's, and so on. All on rank 0 is a share like any other. */
typedef struct OstMeshArrays {
    int nodes_per_tet;                   /* 4 or 10, in the order stated above */
    OstLocal node_count;                 /* of this rank's share */
    const double *coordinates;           /* node_count × 3, in the user's unit of length */
    OstLocal tet_count;                  /* of this rank's share */
    const OstGlobal *tet_nodes;          /* tet_count × nodes_per_tet */
    const double *tet_axes;              /* tet_count × 9, rows e1 e2 e3 of the material; NULL: none */
    const int32_t *tet_region;           /* tet_count, from 0 into region_names; NULL: all in region 0 */
    int region_count;                    /* 0: one region called "body" */
    const char *const *region_names;     /* region_count different names, the same on every rank */
    int boundary_count;                  /* may be 0 */
    const OstBoundaryArrays *boundaries; /* boundary_count, the same list on every rank, with this rank's items */
} OstMeshArrays;

/* Collective. A mesh of the caller's own; everything is copied. A rank other than 0 that has no share may pass NULL.
 * Tet t and node n have the labels t + 1 and n + 1: by these, messages name them and a case's `vertices` selects. A
 * case uses the axes of the tets where its material says `axes: {cells: mesh}`. Raises OST_INVALID_INPUT for a missing
 * array, a name that is missing, doubled or different between ranks, a coordinate that is not finite, and a node or
 * region number out of range; ost_mesh_distribute looks for inverted and flat tets and nodes that no tet uses. */
OstStatus ost_chunk_create_from_arrays(OstContext *ctx, const OstMeshArrays *arrays, OstMeshChunk **chunk);
void ost_chunk_destroy(OstMeshChunk **chunk);

/* Collective. Checks the chunk (finite coordinates, no inverted or flat tet, node numbers in range, no node used twice
 * by a tet), partitions it with METIS into as many parts as there are ranks, moves every piece to its rank, and checks
 * that each vertex is used by a tet. The chunk is consumed: destroyed, and the pointer nulled. Raises OST_INVALID_INPUT
 * naming the tet or vertex by its label, and OST_LIMIT_EXCEEDED where METIS' 32-bit numbers would overflow. */
OstStatus ost_mesh_distribute(OstContext *ctx, OstMeshChunk **chunk, OstMesh **mesh);

/* Where the borders between ranks had better not run: `fill` (local; called where there is more than one rank) gives
 * the material's metric in each of the chunk's tets, 6 numbers (11 22 33 12 23 31) whose largest eigenvalue is 1, short
 * along what is stiff, from the tets' centroids (3 numbers each). */
typedef struct OstTetMetric {
    const void *data;
    OstStatus (*fill)(const void *data, const OstMeshChunk *chunk, const double *centroids, double *metric);
} OstTetMetric;

/* Collective. As ost_mesh_distribute, with edges as heavy as they are stiff (`tets` NULL: all alike). */
OstStatus ost_mesh_distribute_by(OstContext *ctx, OstMeshChunk **chunk, const OstTetMetric *tets, OstMesh **mesh);
void ost_mesh_destroy(OstMesh **mesh);

/* Local. Number of a name, region or boundary, or -1; and the names in one line, for messages (cut
 * with dots where they do not fit). */
int ost_names_find(const OstNames *names, const char *name);
int ost_mesh_find_region(const OstMesh *mesh, const char *name);
int ost_mesh_find_boundary(const OstMesh *mesh, const char *name);
void ost_names_list(const OstNames *names, char *text, size_t size);
void ost_mesh_list_boundaries(const OstMesh *mesh, char *text, size_t size);

/* Local. Does this rank own the item with these local nodes? (The owner of its lowest global number does.) */
int ost_mesh_owns(const OstMesh *mesh, int count, const OstGlobal *nodes);

/* Collective. Faces of the body's surface that touch an owned node, oriented outwards: vertices, then mid-edges. `tet`
 * is the tet behind each. Arrays are the caller's to free (ost_surface_destroy). */
typedef struct OstSurface {
    OstLocal count;
    int nodes_per_face;
    OstLocal *nodes; /* count × nodes_per_face, local numbers */
    OstLocal *tet;
} OstSurface;
OstStatus ost_surface_create(const OstMesh *mesh, OstSurface **surface);
void ost_surface_destroy(OstSurface **surface);

/* Local. Signed volume of a tet's four vertices; edge-based shape measure 6√2·V / (mean edge)³, 1 for a regular tet. */
double ost_tet_volume(const double *coordinates, const OstLocal *nodes);
double ost_tet_quality(const double *coordinates, const OstLocal *nodes);

/* Local. Mean of the four vertices of every tet held here (owned or not): tet_count × 3 numbers of the caller. */
OstStatus ost_mesh_tet_centroids(const OstMesh *mesh, double *centroids);

/* Collective. The smallest box around all nodes of the body. */
OstStatus ost_mesh_bounds(const OstMesh *mesh, double low[3], double high[3]);

OST_API_END

#endif

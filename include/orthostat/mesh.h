/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_H
#define ORTHOSTAT_MESH_H

#include "orthostat/context.h"

OST_API_BEGIN

/* Tets have 4 or 10 nodes. Vertices 0-3 are positively oriented: (x1-x0)·((x2-x0)×(x3-x0)) > 0. The six mid-edge nodes
 * follow in VTK's order: 01 12 02 03 13 23. Faces have 3 or 6 nodes (vertices, then mid-edges 01 12 20), curves 2 or 3,
 * points 1. */

/* This rank's share of a mesh before it is partitioned. Numbers are global, from 0. */
typedef struct OstMeshChunk OstMeshChunk;

/* One rank's piece of the partitioned mesh: its own nodes, every tet that touches one of them, and the other nodes of
 * those tets as ghosts. Numbers are local: owned nodes come first, then ghosts; owned tets come first, then the others.
 * Regions and boundary names are the same on every rank. */
typedef struct OstMesh OstMesh;

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
 * that each vertex is used by a tet. Labels of the mesh are 1 or more: those of a file that counts from 0 become one
 * more. The chunk is consumed: destroyed, and the pointer nulled. Raises OST_INVALID_INPUT naming the tet or vertex by
 * its label, and OST_LIMIT_EXCEEDED where METIS' 32-bit numbers would overflow. */
OstStatus ost_mesh_distribute(OstContext *ctx, OstMeshChunk **chunk, OstMesh **mesh);

void ost_mesh_destroy(OstMesh **mesh);

/* Local. The sizes of a mesh: over the whole body, and of this rank's piece, of which it owns the first ones. */
int ost_mesh_nodes_per_tet(const OstMesh *mesh);
OstGlobal ost_mesh_global_nodes(const OstMesh *mesh);
OstGlobal ost_mesh_global_tets(const OstMesh *mesh);
OstLocal ost_mesh_node_count(const OstMesh *mesh);
OstLocal ost_mesh_owned_nodes(const OstMesh *mesh);
OstLocal ost_mesh_tet_count(const OstMesh *mesh);
OstLocal ost_mesh_owned_tets(const OstMesh *mesh);

/* Local. The arrays of this rank's piece, which live as long as the mesh. Labels are the numbers of the file or of the
 * caller's arrays (from 1), whatever the partition. */
const double *ost_mesh_coordinates(const OstMesh *mesh);    /* node_count × 3 */
const OstGlobal *ost_mesh_node_labels(const OstMesh *mesh); /* node_count */
const OstLocal *ost_mesh_tet_nodes(const OstMesh *mesh);    /* tet_count × nodes_per_tet, local numbers */
const OstGlobal *ost_mesh_tet_labels(const OstMesh *mesh);  /* tet_count */
const int32_t *ost_mesh_tet_regions(const OstMesh *mesh);   /* tet_count */
const double *ost_mesh_tet_axes(const OstMesh *mesh);       /* tet_count × 9: rows e1 e2 e3; NULL: the mesh has none */

/* Local. Named regions and boundaries: how many, the name of one, and the number of a name, or -1. */
int ost_mesh_region_count(const OstMesh *mesh);
const char *ost_mesh_region_name(const OstMesh *mesh, int region);
int ost_mesh_find_region(const OstMesh *mesh, const char *name);
int ost_mesh_boundary_count(const OstMesh *mesh);
const char *ost_mesh_boundary_name(const OstMesh *mesh, int boundary);
int ost_mesh_find_boundary(const OstMesh *mesh, const char *name);

/* Local. The items of a boundary that touch an owned node (points: the owned ones): their number, the nodes of each
 * (1 points; 2, 3 curves; 3, 6 faces), and their local nodes, item by item, which live as long as the mesh. */
OstLocal ost_mesh_boundary_items(const OstMesh *mesh, int boundary, int *nodes_per_item, const OstGlobal **nodes);

/* Local. Signed volume of a tet's four vertices; edge-based shape measure 6√2·V / (mean edge)³, 1 for a regular tet. */
double ost_tet_volume(const double *coordinates, const OstLocal *nodes);
double ost_tet_quality(const double *coordinates, const OstLocal *nodes);

/* Local. Mean of the four vertices of every tet held here (owned or not): tet_count × 3 numbers of the caller. */
OstStatus ost_mesh_tet_centroids(const OstMesh *mesh, double *centroids);

/* Collective. The smallest box around all nodes of the body. */
OstStatus ost_mesh_bounds(const OstMesh *mesh, double low[3], double high[3]);

OST_API_END

#endif

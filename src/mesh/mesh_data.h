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
struct OstMeshChunk {
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
};

/* One rank's piece of the partitioned mesh: its own nodes, every tet that touches one of them, and the other nodes of
 * those tets as ghosts. Local numbers: owned nodes first, then ghosts grouped by owner. Tets: those this rank owns (the
 * owner of a tet is the owner of its node with the lowest global number) first. Boundaries hold every item that touches
 * an owned node, and points only where owned; regions and boundary names are the same on every rank. */
struct OstMesh {
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
};

/* Where the borders between ranks had better not run: `fill` (local; called where there is more than one rank) gives
 * the material's metric in each of the chunk's tets, 6 numbers (11 22 33 12 23 31) whose largest eigenvalue is 1, short
 * along what is stiff, from the tets' centroids (3 numbers each). */
typedef struct OstTetMetric {
    const void *data;
    OstStatus (*fill)(const void *data, const OstMeshChunk *chunk, const double *centroids, double *metric);
} OstTetMetric;

/* Collective. As ost_mesh_distribute, with edges as heavy as they are stiff (`tets` NULL: all alike). */
OstStatus ost_mesh_distribute_by(OstContext *ctx, OstMeshChunk **chunk, const OstTetMetric *tets, OstMesh **mesh);

/* Local. Number of a name, region or boundary, or -1; and the names in one line, for messages (cut
 * with dots where they do not fit). */
int ost_names_find(const OstNames *names, const char *name);
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

#endif

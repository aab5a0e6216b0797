/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_POINTS_H
#define ORTHOSTAT_FORMATS_VTKHDF_POINTS_H

#include "formats/vtkhdf/hdf5.h"
#include "mesh/mesh_data.h"

/* Each piece of a file has its own copy of the points it uses, so a node on the border of pieces occurs several times.
 * The first of these points in the file becomes the node; nodes are numbered in the order of their points. */

/* Names of point arrays that say which points of pieces are one; NULL after the last. The first is that of vertex
 * numbers in a file of Orthostat, the others number the points of other programs over all pieces. */
extern const char *const ost_point_labels[];

/* This rank's share of the file's points, regardless of where pieces begin and end. */
typedef struct OstFilePoints {
    OstGlobal first, total; /* in the file, over all pieces */
    OstLocal count;
    OstGlobal piece_count;
    OstGlobal *piece_start; /* piece_count + 1: first point of each piece */
    double *coordinates;    /* count × 3 */
    OstGlobal *label;       /* NULL if the file has no array of them */
    const char *labelled;   /* its name: "vertex", or another program's numbers over all pieces, not kept */
    OstGlobal *node;        /* number of the node each point is, once merged */
} OstFilePoints;

/* Collective. Finds which points are one node: those with equal labels, or with bitwise equal coordinates if the file
 * has no labels. Fills the chunk's nodes, and each point's node number. Raises OST_INVALID_INPUT if a piece has a label
 * twice, or a label is at two places. */
OstStatus ost_file_points_merge(const OstHdf5 *h5, OstFilePoints *points, OstMeshChunk *chunk);

/* Collective. Replaces points of the file (numbers over all pieces) by their nodes' numbers. */
OstStatus ost_file_points_to_nodes(OstContext *ctx, const OstFilePoints *points, size_t count, OstGlobal *point);

void ost_file_points_free(OstFilePoints *points);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_PIECE_H
#define ORTHOSTAT_FORMATS_VTKHDF_PIECE_H

#include "formats/vtkhdf/hdf5.h"
#include "formats/vtkhdf/vtkhdf.h"

/* What a rank writes: its owned tets and the nodes they use, renumbered from 0. */
typedef struct OstPiece {
    const OstMesh *mesh;
    OstLocal point_count;
    OstLocal *point; /* of each local node, or -1 if no owned tet uses it */
    OstLocal *node;  /* of each point */
    int is_whole;    /* the points are the local nodes in their order: no gathering needed */
    void *gathered;  /* values in the order of the points */
    OstRows one;     /* one row for each piece */
    OstRows points;  /* rows of the whole file's arrays */
    OstRows tets;
    OstRows offsets;
    OstRows connectivity;
} OstPiece;

/* Collective. `row_bytes` is the largest row of a point array that will be gathered. */
OstStatus ost_piece_create(const OstMesh *mesh, size_t row_bytes, OstPiece *piece);
void ost_piece_free(OstPiece *piece);

/* Local. Values by local node as values by point: the same array if is_whole, else rows gathered in the piece, valid
 * until the next call. */
const void *ost_piece_gather(OstPiece *piece, size_t row_bytes, const void *values);

/* Collective. Points, Connectivity, Offsets, Types and their numbers. */
OstStatus ost_piece_write_shape(OstHdf5 *h5, OstPiece *piece);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/hexes.h"

#include "core/error.h"
#include "core/memory.h"
#include "mesh/tet.h"

/* The paths from corner 000 to corner 111 along the edges of a cell: one tet for each order of the three directions.
 * Odd orders have their second and last vertices swapped, so that every tet is positively oriented. This keeps the pair
 * of edges 02 and 13, whose middles Bey's refinement joins by a diagonal (see refine.c). */
static const int tet_corner[HEX_TETS][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                            {0, 7, 5, 1}, {0, 7, 6, 4}, {0, 7, 3, 2}};

/* Writes the 6 nodes of the two faces at one end (high: 0 or 1) of a direction, outward; returns the address after. */
static OstGlobal *write_faces(const OstGlobal corner[HEX_CORNERS], int direction, int high, OstGlobal *node)
{
    for (int t = 0; t < HEX_TETS; t++) {
        int away = 0;
        int opposite = -1;
        for (int v = 0; v < 4; v++) {
            if ((tet_corner[t][v] >> direction & 1) != high) {
                away++;
                opposite = v;
            }
        }
        if (away == 1)
            for (int v = 0; v < 3; v++)
                *node++ = corner[tet_corner[t][ost_tet_face[opposite][v]]];
    }
    return node;
}

static OstStatus find_share(OstContext *ctx, const char *shape, const char *what, OstGlobal total, OstGlobal *first,
                            OstLocal *count)
{
    const int size = ost_size(ctx);
    const OstGlobal each = total / size;
    const OstGlobal rest = total % size;
    const OstGlobal rank = ost_rank(ctx);
    if (each >= INT32_MAX / HEX_TETS)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "%s: %lld %s on %d rank%s are more than the %d that one rank can number; use more ranks",
                         shape, (long long)total, what, size, size == 1 ? "" : "s", INT32_MAX / HEX_TETS);
    *first = rank * each + (rank < rest ? rank : rest);
    *count = (OstLocal)(each + (rank < rest ? 1 : 0));
    return OST_SUCCESS;
}

static OstStatus make_nodes(const Hexes *hexes, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->coordinates, 3 * (size_t)chunk->node_count));
    for (OstLocal i = 0; i < chunk->node_count; i++)
        hexes->place(hexes->shape, chunk->first_node + i, chunk->coordinates + 3 * (size_t)i);
    return OST_SUCCESS;
}

static OstStatus make_tets(const Hexes *hexes, OstGlobal first_cell, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_nodes, 4 * (size_t)chunk->tet_count));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_region, chunk->tet_count));
    OstGlobal *node = chunk->tet_nodes;
    for (OstLocal i = 0; i < chunk->tet_count / HEX_TETS; i++) {
        OstGlobal corner[HEX_CORNERS];
        hexes->corners(hexes->shape, first_cell + i, corner);
        for (int t = 0; t < HEX_TETS; t++)
            for (int v = 0; v < 4; v++)
                *node++ = corner[tet_corner[t][v]];
    }
    return OST_SUCCESS;
}

static OstStatus make_boundary(const Hexes *hexes, int side, OstGlobal first_cell, OstMeshChunk *chunk)
{
    const OstLocal cells = chunk->tet_count / HEX_TETS;
    OstBoundary *boundary = &chunk->boundaries[chunk->boundary_count++];
    int direction = 0;
    boundary->dimension = 2;
    boundary->nodes_per_item = 3;
    OST_TRY(ost_copy_string(chunk->ctx, hexes->side_name(hexes->shape, side), &boundary->name));
    for (OstLocal i = 0; i < cells; i++) {
        const int ends = hexes->ends(hexes->shape, side, first_cell + i, &direction);
        boundary->count += 2 * (((ends & HEX_LOW) != 0) + ((ends & HEX_HIGH) != 0));
    }
    OST_TRY(OST_NEW(chunk->ctx, &boundary->nodes, 3 * (size_t)boundary->count));
    OstGlobal *node = boundary->nodes;
    for (OstLocal i = 0; i < cells; i++) {
        const int ends = hexes->ends(hexes->shape, side, first_cell + i, &direction);
        OstGlobal corner[HEX_CORNERS];
        if (ends == 0)
            continue;
        hexes->corners(hexes->shape, first_cell + i, corner);
        if (ends & HEX_LOW)
            node = write_faces(corner, direction, 0, node);
        if (ends & HEX_HIGH)
            node = write_faces(corner, direction, 1, node);
    }
    return OST_SUCCESS;
}

static OstStatus fill_chunk(const Hexes *hexes, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    OstGlobal first_cell = 0;
    OstLocal cell_count = 0;
    chunk->nodes_per_tet = 4;
    chunk->global_nodes = hexes->nodes;
    chunk->global_tets = hexes->cells * HEX_TETS;
    OST_TRY(find_share(ctx, hexes->name, "cells", hexes->cells, &first_cell, &cell_count));
    OST_TRY(find_share(ctx, hexes->name, "nodes", hexes->nodes, &chunk->first_node, &chunk->node_count));
    chunk->first_tet = first_cell * HEX_TETS;
    chunk->tet_count = cell_count * HEX_TETS;
    OST_TRY(make_nodes(hexes, chunk));
    OST_TRY(make_tets(hexes, first_cell, chunk));
    OST_TRY(OST_NEW(ctx, &chunk->regions.name, 1));
    chunk->regions.count = 1;
    OST_TRY(ost_copy_string(ctx, hexes->region, &chunk->regions.name[0]));
    OST_TRY(OST_NEW(ctx, &chunk->boundaries, hexes->sides));
    for (int side = 0; side < hexes->sides; side++)
        OST_TRY(make_boundary(hexes, side, first_cell, chunk));
    return OST_SUCCESS;
}

OstStatus ost_hexes_create_chunk(OstContext *ctx, const Hexes *hexes, OstMeshChunk **chunk)
{
    *chunk = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    OstStatus status = OST_NEW(ctx, chunk, 1);
    if (status == OST_SUCCESS) {
        (*chunk)->ctx = ctx;
        status = fill_chunk(hexes, *chunk);
    }
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    ost_ledger_leave(ctx);
    return status;
}

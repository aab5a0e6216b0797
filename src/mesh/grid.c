/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/grid.h"

#include "core/error.h"
#include "core/memory.h"
#include "mesh/kuhn.h"

static OstGlobal nodes_along(const Grid *grid, int direction)
{
    return (OstGlobal)grid->cells[direction] + (grid->round[direction] ? 0 : 1);
}

/* Index triple of a node or cell from its number. */
static void unfold(OstGlobal number, OstGlobal second, OstGlobal third, OstGlobal index[3])
{
    index[2] = number % third;
    index[1] = number / third % second;
    index[0] = number / third / second;
}

static void cell_corners(const Grid *grid, const OstGlobal cell[3], OstGlobal corner[KUHN_CORNERS])
{
    const OstGlobal second = nodes_along(grid, 1);
    const OstGlobal third = nodes_along(grid, 2);
    for (int c = 0; c < KUHN_CORNERS; c++) {
        OstGlobal index[3];
        for (int d = 0; d < 3; d++) {
            index[d] = cell[d] + (c >> d & 1);
            if (grid->round[d] && index[d] == grid->cells[d])
                index[d] = 0;
        }
        corner[c] = (index[0] * second + index[1]) * third + index[2];
    }
}

/* The product of three counts below 2^32 fits 64 bits only if it is checked first. */
static OstStatus check_size(OstContext *ctx, const Grid *grid)
{
    double nodes = 1.0;
    for (int d = 0; d < 3; d++)
        nodes *= (double)grid->cells[d] + 1.0;
    if (nodes > (double)(INT64_MAX / KUHN_CORNERS))
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%s: %d x %d x %d cells are more than 64-bit numbers can count",
                         grid->name, grid->cells[0], grid->cells[1], grid->cells[2]);
    return OST_SUCCESS;
}

static OstStatus make_nodes(const Grid *grid, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->coordinates, 3 * (size_t)chunk->node_count));
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        OstGlobal index[3];
        unfold(chunk->first_node + i, nodes_along(grid, 1), nodes_along(grid, 2), index);
        grid->place(grid->shape, index, chunk->coordinates + 3 * (size_t)i);
    }
    return OST_SUCCESS;
}

static OstStatus make_tets(const Grid *grid, OstGlobal first_cell, OstLocal cell_count, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_nodes, 4 * (size_t)chunk->tet_count));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_region, chunk->tet_count));
    OstGlobal *node = chunk->tet_nodes;
    for (OstLocal i = 0; i < cell_count; i++) {
        OstGlobal cell[3];
        OstGlobal corner[KUHN_CORNERS];
        unfold(first_cell + i, grid->cells[1], grid->cells[2], cell);
        cell_corners(grid, cell, corner);
        node = ost_kuhn_tets(corner, node);
    }
    return OST_SUCCESS;
}

/* Which ends of the side's direction does the cell lie at? */
static int ends_touched(const Grid *grid, const GridSide *side, const OstGlobal cell[3])
{
    const OstGlobal index = cell[side->direction];
    const int low = index == 0 ? GRID_LOW : 0;
    const int high = index == grid->cells[side->direction] - 1 ? GRID_HIGH : 0;
    return side->ends & (low | high);
}

static OstStatus make_boundary(const Grid *grid, const GridSide *side, OstGlobal first_cell, OstLocal cell_count,
                               OstMeshChunk *chunk)
{
    OstBoundary *boundary = &chunk->boundaries[chunk->boundary_count++];
    boundary->dimension = 2;
    boundary->nodes_per_item = 3;
    OST_TRY(ost_copy_string(chunk->ctx, side->name, &boundary->name));
    OstGlobal cell[3];
    for (OstLocal i = 0; i < cell_count; i++) {
        unfold(first_cell + i, grid->cells[1], grid->cells[2], cell);
        const int ends = ends_touched(grid, side, cell);
        boundary->count += 2 * ((ends & GRID_LOW ? 1 : 0) + (ends & GRID_HIGH ? 1 : 0));
    }
    OST_TRY(OST_NEW(chunk->ctx, &boundary->nodes, 3 * (size_t)boundary->count));
    OstGlobal *node = boundary->nodes;
    for (OstLocal i = 0; i < cell_count; i++) {
        unfold(first_cell + i, grid->cells[1], grid->cells[2], cell);
        const int ends = ends_touched(grid, side, cell);
        if (ends == 0)
            continue;
        OstGlobal corner[KUHN_CORNERS];
        cell_corners(grid, cell, corner);
        if (ends & GRID_LOW)
            node = ost_kuhn_faces(corner, side->direction, 0, node);
        if (ends & GRID_HIGH)
            node = ost_kuhn_faces(corner, side->direction, 1, node);
    }
    return OST_SUCCESS;
}

static OstStatus make_names(const Grid *grid, int side_count, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->regions.name, 1));
    chunk->regions.count = 1;
    OST_TRY(ost_copy_string(chunk->ctx, grid->name, &chunk->regions.name[0]));
    return OST_NEW(chunk->ctx, &chunk->boundaries, side_count);
}

static OstStatus fill_chunk(const Grid *grid, int side_count, const GridSide *sides, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    OST_TRY(check_size(ctx, grid));
    const OstGlobal cells = (OstGlobal)grid->cells[0] * grid->cells[1] * grid->cells[2];
    chunk->nodes_per_tet = 4;
    chunk->global_nodes = nodes_along(grid, 0) * nodes_along(grid, 1) * nodes_along(grid, 2);
    chunk->global_tets = cells * KUHN_TETS;
    OstGlobal first_cell = 0;
    OstLocal cell_count = 0;
    OST_TRY(ost_kuhn_share(ctx, grid->name, "cells", cells, &first_cell, &cell_count));
    OST_TRY(ost_kuhn_share(ctx, grid->name, "nodes", chunk->global_nodes, &chunk->first_node, &chunk->node_count));
    chunk->first_tet = first_cell * KUHN_TETS;
    chunk->tet_count = cell_count * KUHN_TETS;
    OST_TRY(make_nodes(grid, chunk));
    OST_TRY(make_tets(grid, first_cell, cell_count, chunk));
    OST_TRY(make_names(grid, side_count, chunk));
    for (int s = 0; s < side_count; s++)
        OST_TRY(make_boundary(grid, &sides[s], first_cell, cell_count, chunk));
    return OST_SUCCESS;
}

OstStatus ost_grid_create_chunk(OstContext *ctx, const Grid *grid, int side_count, const GridSide *sides,
                                OstMeshChunk **chunk)
{
    *chunk = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    OstStatus status = OST_NEW(ctx, chunk, 1);
    if (status == OST_SUCCESS) {
        (*chunk)->ctx = ctx;
        status = fill_chunk(grid, side_count, sides, *chunk);
    }
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    ost_ledger_leave(ctx);
    return status;
}

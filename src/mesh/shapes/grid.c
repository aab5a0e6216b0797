/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/shapes/grid.h"

#include "core/error.h"

typedef struct Sided {
    const Grid *grid;
    const GridSide *side;
} Sided;

static OstGlobal nodes_along(const Grid *grid, int direction)
{
    return (OstGlobal)grid->cells[direction] + (grid->round[direction] ? 0 : 1);
}

/* Index triple of a node or cell from its number; `second` and `third` are the counts in these directions. */
static void unfold(OstGlobal number, OstGlobal second, OstGlobal third, OstGlobal index[3])
{
    index[2] = number % third;
    index[1] = number / third % second;
    index[0] = number / third / second;
}

static void place_node(const void *shape, OstGlobal node, double x[3])
{
    const Grid *grid = ((const Sided *)shape)->grid;
    OstGlobal index[3];
    unfold(node, nodes_along(grid, 1), nodes_along(grid, 2), index);
    grid->place(grid->shape, index, x);
}

static void find_corners(const void *shape, OstGlobal number, OstGlobal corner[HEX_CORNERS])
{
    const Grid *grid = ((const Sided *)shape)->grid;
    const OstGlobal second = nodes_along(grid, 1);
    const OstGlobal third = nodes_along(grid, 2);
    OstGlobal cell[3];
    unfold(number, grid->cells[1], grid->cells[2], cell);
    for (int c = 0; c < HEX_CORNERS; c++) {
        OstGlobal index[3];
        for (int d = 0; d < 3; d++) {
            index[d] = cell[d] + (c >> d & 1);
            if (grid->round[d] && index[d] == grid->cells[d])
                index[d] = 0;
        }
        corner[c] = (index[0] * second + index[1]) * third + index[2];
    }
}

static const char *name_side(const void *shape, int side)
{
    return ((const Sided *)shape)->side[side].name;
}

/* The ends of the side's direction at which the cell lies. */
static int find_ends(const void *shape, int number, OstGlobal cell, int *direction)
{
    const Grid *grid = ((const Sided *)shape)->grid;
    const GridSide *side = &((const Sided *)shape)->side[number];
    OstGlobal index[3];
    unfold(cell, grid->cells[1], grid->cells[2], index);
    *direction = side->direction;
    const int low = index[*direction] == 0 ? HEX_LOW : 0;
    const int high = index[*direction] == grid->cells[*direction] - 1 ? HEX_HIGH : 0;
    return side->ends & (low | high);
}

/* In floating point: the product of three 32-bit counts may overflow 64 bits. */
static OstStatus check_size(OstContext *ctx, const Grid *grid)
{
    double nodes = 1.0;
    for (int d = 0; d < 3; d++)
        nodes *= (double)grid->cells[d] + 1.0;
    if (nodes > (double)(INT64_MAX / HEX_CORNERS))
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%s: %d x %d x %d cells are more than 64-bit numbers can count",
                         grid->name, grid->cells[0], grid->cells[1], grid->cells[2]);
    return OST_SUCCESS;
}

OstStatus ost_grid_create_chunk(OstContext *ctx, const Grid *grid, int side_count, const GridSide *sides,
                                OstMeshChunk **chunk)
{
    const Sided shape = {grid, sides};
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_size(ctx, grid)));
    const Hexes hexes = {.name = grid->name,
                         .region = grid->name,
                         .nodes = nodes_along(grid, 0) * nodes_along(grid, 1) * nodes_along(grid, 2),
                         .cells = (OstGlobal)grid->cells[0] * grid->cells[1] * grid->cells[2],
                         .sides = side_count,
                         .shape = &shape,
                         .place = place_node,
                         .corners = find_corners,
                         .side_name = name_side,
                         .ends = find_ends};
    return ost_hexes_create_chunk(ctx, &hexes, chunk);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "mesh/shapes/grid.h"

#include <math.h>

static void place(const void *data, const OstGlobal index[3], double x[3])
{
    const OstBlockShape *block = data;
    for (int d = 0; d < 3; d++)
        x[d] = block->origin[d] + block->size[d] * (double)index[d] / block->divisions[d];
}

static OstStatus check_shape(OstContext *ctx, const OstBlockShape *block)
{
    for (int d = 0; d < 3; d++) {
        const char name = (char)('x' + d);
        if (!isfinite(block->origin[d]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "block: origin has %c = %g, expected a finite number", name,
                             block->origin[d]);
        if (!isfinite(block->size[d]) || block->size[d] <= 0.0)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "block: size along %c is %g, expected a positive number", name,
                             block->size[d]);
        if (block->divisions[d] < 1)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "block: %d divisions along %c, expected at least 1",
                             block->divisions[d], name);
    }
    return OST_SUCCESS;
}

OstStatus ost_chunk_create_block(OstContext *ctx, const OstBlockShape *shape, OstMeshChunk **chunk)
{
    static const GridSide sides[] = {{"xmin", 0, HEX_LOW},  {"xmax", 0, HEX_HIGH}, {"ymin", 1, HEX_LOW},
                                     {"ymax", 1, HEX_HIGH}, {"zmin", 2, HEX_LOW},  {"zmax", 2, HEX_HIGH}};
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_shape(ctx, shape)));
    const Grid grid = {
        "block", {shape->divisions[0], shape->divisions[1], shape->divisions[2]}, {0, 0, 0}, shape, place};
    return ost_grid_create_chunk(ctx, &grid, sizeof sides / sizeof *sides, sides, chunk);
}

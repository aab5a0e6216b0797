/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "mesh/shapes/grid.h"

#include <math.h>

/* Index directions: along the axis, around it, through the wall. */
static void place(const void *data, const OstGlobal index[3], double x[3])
{
    const OstTubeShape *tube = data;
    const double angle = 2.0 * M_PI * (double)index[1] / tube->around;
    const double radius = tube->radii[0] + (tube->radii[1] - tube->radii[0]) * (double)index[2] / tube->radial;
    const int axis = tube->axis;
    x[axis] = tube->length * (double)index[0] / tube->axial;
    x[(axis + 2) % 3] = radius * cos(angle);
    x[(axis + 1) % 3] = radius * sin(angle);
    for (int d = 0; d < 3; d++)
        x[d] += tube->origin[d];
}

static OstStatus check_shape(OstContext *ctx, const OstTubeShape *tube)
{
    if (tube->axis < 0 || tube->axis > 2)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: axis is number %d, expected x (0), y (1) or z (2)", tube->axis);
    for (int d = 0; d < 3; d++)
        if (!isfinite(tube->origin[d]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: origin has the coordinate %g, expected a finite number",
                             tube->origin[d]);
    if (!isfinite(tube->length) || tube->length <= 0.0)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: length is %g, expected a positive number", tube->length);
    if (!isfinite(tube->radii[1]) || !(tube->radii[0] > 0.0) || !(tube->radii[0] < tube->radii[1]))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: radii are [%g, %g], expected 0 < inner < outer", tube->radii[0],
                         tube->radii[1]);
    if (tube->around < 3)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: %d divisions around, expected at least 3", tube->around);
    if (tube->radial < 1 || tube->axial < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: %d radial and %d axial divisions, expected at least 1 of each",
                         tube->radial, tube->axial);
    return OST_SUCCESS;
}

OstStatus ost_chunk_create_tube(OstContext *ctx, const OstTubeShape *shape, OstMeshChunk **chunk)
{
    static const GridSide sides[] = {{"bottom", 0, HEX_LOW},
                                     {"top", 0, HEX_HIGH},
                                     {"ends", 0, HEX_LOW | HEX_HIGH},
                                     {"inner", 2, HEX_LOW},
                                     {"outer", 2, HEX_HIGH}};
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_shape(ctx, shape)));
    const Grid grid = {"tube", {shape->axial, shape->around, shape->radial}, {0, 1, 0}, shape, place};
    return ost_grid_create_chunk(ctx, &grid, sizeof sides / sizeof *sides, sides, chunk);
}

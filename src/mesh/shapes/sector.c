/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "mesh/shapes/grid.h"

#include <math.h>

/* Cosine and sine of an angle in degrees, without rounding errors at multiples of 90, so that the nodes there lie in
 * the plane of symmetry. */
static void turn(double degrees, double *cosine, double *sine)
{
    static const double quarter[4][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
    *cosine = cos(degrees * M_PI / 180.0);
    *sine = sin(degrees * M_PI / 180.0);
    if (fmod(degrees, 90.0) == 0.0) {
        *cosine = quarter[(int)(degrees / 90.0) % 4][0];
        *sine = quarter[(int)(degrees / 90.0) % 4][1];
    }
}

/* Index directions: along the axis, around it, through the wall. */
static void place(const void *data, const OstGlobal index[3], double x[3])
{
    const OstSectorShape *sector = data;
    const double radius = sector->radii[0] + (sector->radii[1] - sector->radii[0]) * (double)index[2] / sector->radial;
    double cosine = 0.0;
    double sine = 0.0;
    turn(sector->angle * (double)index[1] / sector->around, &cosine, &sine);
    const int axis = sector->axis;
    x[axis] = sector->length * (double)index[0] / sector->axial;
    x[(axis + 2) % 3] = radius * cosine;
    x[(axis + 1) % 3] = radius * sine;
    for (int d = 0; d < 3; d++)
        x[d] += sector->origin[d];
}

static OstStatus check_shape(OstContext *ctx, const OstSectorShape *sector)
{
    if (sector->axis < 0 || sector->axis > 2)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "sector: axis is number %d, expected x (0), y (1) or z (2)",
                         sector->axis);
    for (int d = 0; d < 3; d++)
        if (!isfinite(sector->origin[d]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "sector: origin has the coordinate %g, expected a finite number",
                             sector->origin[d]);
    if (!isfinite(sector->length) || sector->length <= 0.0)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "sector: length is %g, expected a positive number", sector->length);
    if (!isfinite(sector->radii[1]) || !(sector->radii[0] > 0.0) || !(sector->radii[0] < sector->radii[1]))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "sector: radii are [%g, %g], expected 0 < inner < outer",
                         sector->radii[0], sector->radii[1]);
    if (!(sector->angle > 0.0) || !(sector->angle < 360.0))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "sector: angle is %g degrees, expected more than 0 and less than 360 (a tube goes all round)",
                         sector->angle);
    if (sector->around < 1 || sector->radial < 1 || sector->axial < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "sector: %d divisions around, %d radial and %d axial, expected at least 1 of each",
                         sector->around, sector->radial, sector->axial);
    if (sector->angle / sector->around >= 180.0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "sector: %d divisions around make steps of %g degrees, expected less than 180", sector->around,
                         sector->angle / sector->around);
    return OST_SUCCESS;
}

OstStatus ost_chunk_create_sector(OstContext *ctx, const OstSectorShape *shape, OstMeshChunk **chunk)
{
    static const GridSide sides[] = {{"bottom", 0, HEX_LOW}, {"top", 0, HEX_HIGH},  {"inner", 2, HEX_LOW},
                                     {"outer", 2, HEX_HIGH}, {"start", 1, HEX_LOW}, {"finish", 1, HEX_HIGH}};
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_shape(ctx, shape)));
    const Grid grid = {"sector", {shape->axial, shape->around, shape->radial}, {0, 0, 0}, shape, place};
    return ost_grid_create_chunk(ctx, &grid, sizeof sides / sizeof *sides, sides, chunk);
}

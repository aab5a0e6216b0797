/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "mesh/shapes/grid.h"

#include <math.h>

/* A tube and its sector. Index directions: along the axis, around it, through the wall. */
static void place(int axis, const double origin[3], double height, double across, double side, double x[3])
{
    x[axis] = height;
    x[(axis + 2) % 3] = across;
    x[(axis + 1) % 3] = side;
    for (int d = 0; d < 3; d++)
        x[d] += origin[d];
}

static void place_in_tube(const void *data, const OstGlobal index[3], double x[3])
{
    const OstTubeShape *tube = data;
    const double angle = 2.0 * M_PI * (double)index[1] / tube->around;
    const double radius = tube->radii[0] + (tube->radii[1] - tube->radii[0]) * (double)index[2] / tube->radial;
    place(tube->axis, tube->origin, tube->length * (double)index[0] / tube->axial, radius * cos(angle),
          radius * sin(angle), x);
}

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

static void place_in_sector(const void *data, const OstGlobal index[3], double x[3])
{
    const OstSectorShape *sector = data;
    const double radius = sector->radii[0] + (sector->radii[1] - sector->radii[0]) * (double)index[2] / sector->radial;
    double cosine = 0.0;
    double sine = 0.0;
    turn(sector->angle * (double)index[1] / sector->around, &cosine, &sine);
    place(sector->axis, sector->origin, sector->length * (double)index[0] / sector->axial, radius * cosine,
          radius * sine, x);
}

/* Checks what both shapes have; `name` is the shape's, for messages. */
static OstStatus check_wall(OstContext *ctx, const char *name, int axis, const double origin[3], double length,
                            const double radii[2])
{
    if (axis < 0 || axis > 2)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: axis is number %d, expected x (0), y (1) or z (2)", name, axis);
    for (int d = 0; d < 3; d++)
        if (!isfinite(origin[d]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: origin has the coordinate %g, expected a finite number", name,
                             origin[d]);
    if (!isfinite(length) || length <= 0.0)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: length is %g, expected a positive number", name, length);
    if (!isfinite(radii[1]) || !(radii[0] > 0.0) || !(radii[0] < radii[1]))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: radii are [%g, %g], expected 0 < inner < outer", name, radii[0],
                         radii[1]);
    return OST_SUCCESS;
}

static OstStatus check_tube(OstContext *ctx, const OstTubeShape *tube)
{
    OST_TRY(check_wall(ctx, "tube", tube->axis, tube->origin, tube->length, tube->radii));
    if (tube->around < 3)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: %d divisions around, expected at least 3", tube->around);
    if (tube->radial < 1 || tube->axial < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "tube: %d radial and %d axial divisions, expected at least 1 of each",
                         tube->radial, tube->axial);
    return OST_SUCCESS;
}

static OstStatus check_sector(OstContext *ctx, const OstSectorShape *sector)
{
    OST_TRY(check_wall(ctx, "sector", sector->axis, sector->origin, sector->length, sector->radii));
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

OstStatus ost_chunk_create_tube(OstContext *ctx, const OstTubeShape *shape, OstMeshChunk **chunk)
{
    static const GridSide sides[] = {{"bottom", 0, HEX_LOW},
                                     {"top", 0, HEX_HIGH},
                                     {"ends", 0, HEX_LOW | HEX_HIGH},
                                     {"inner", 2, HEX_LOW},
                                     {"outer", 2, HEX_HIGH}};
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_tube(ctx, shape)));
    const Grid grid = {"tube", {shape->axial, shape->around, shape->radial}, {0, 1, 0}, shape, place_in_tube};
    return ost_grid_create_chunk(ctx, &grid, sizeof sides / sizeof *sides, sides, chunk);
}

OstStatus ost_chunk_create_sector(OstContext *ctx, const OstSectorShape *shape, OstMeshChunk **chunk)
{
    static const GridSide sides[] = {{"bottom", 0, HEX_LOW}, {"top", 0, HEX_HIGH},  {"inner", 2, HEX_LOW},
                                     {"outer", 2, HEX_HIGH}, {"start", 1, HEX_LOW}, {"finish", 1, HEX_HIGH}};
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_sector(ctx, shape)));
    const Grid grid = {"sector", {shape->axial, shape->around, shape->radial}, {0, 0, 0}, shape, place_in_sector};
    return ost_grid_create_chunk(ctx, &grid, sizeof sides / sizeof *sides, sides, chunk);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "orthostat/refine.h"

/* The sum of two unit vectors counts as 0 if it is shorter than this. */
static const double no_direction = 1e-8;

OstShapeSurface ost_shape_surface_tube(const OstTubeShape *shape)
{
    OstShapeSurface surface = {OST_SURFACE_TUBE, {shape->origin[0], shape->origin[1], shape->origin[2]}, {0.0}};
    surface.axis[shape->axis] = 1.0;
    return surface;
}

OstShapeSurface ost_shape_surface_sphere(const double centre[3])
{
    return (OstShapeSurface){OST_SURFACE_SPHERE, {centre[0], centre[1], centre[2]}, {0.0}};
}

/* Splits the vector from the origin to x into its part along the axis (0 for a sphere) and a unit vector across it;
 * returns the length across. */
static double split(const OstShapeSurface *shape, const double x[3], double along[3], double direction[3])
{
    const double length = shape->kind == OST_SURFACE_TUBE ? ost_dot3(shape->axis, shape->axis) : 0.0;
    double from[3];
    for (int d = 0; d < 3; d++)
        from[d] = x[d] - shape->origin[d];
    const double height = length > 0.0 ? ost_dot3(from, shape->axis) / length : 0.0;
    for (int d = 0; d < 3; d++) {
        along[d] = height * shape->axis[d];
        direction[d] = from[d] - along[d];
    }
    const double radius = ost_norm3(direction);
    for (int d = 0; d < 3; d++)
        direction[d] = radius > 0.0 ? direction[d] / radius : 0.0;
    return radius;
}

/* Averages height, radius and angle: the direction between two unit vectors is that of their sum. */
void ost_shape_surface_middle(const OstShapeSurface *shape, const double a[3], const double b[3], double middle[3])
{
    for (int d = 0; d < 3; d++)
        middle[d] = 0.5 * (a[d] + b[d]);
    if (!shape || shape->kind == OST_SURFACE_NONE)
        return;
    double along[2][3];
    double direction[2][3];
    const double radius = 0.5 * (split(shape, a, along[0], direction[0]) + split(shape, b, along[1], direction[1]));
    const double sum[3] = {direction[0][0] + direction[1][0], direction[0][1] + direction[1][1],
                           direction[0][2] + direction[1][2]};
    const double length = ost_norm3(sum);
    if (length < no_direction)
        return;
    for (int d = 0; d < 3; d++)
        middle[d] = shape->origin[d] + 0.5 * (along[0][d] + along[1][d]) + radius * (sum[d] / length);
}

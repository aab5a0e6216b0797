/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_DIRECTIONS_H
#define ORTHOSTAT_MATERIAL_DIRECTIONS_H

#include "orthostat/axes.h"

/* Axes that vary within a quadratic tet: two of them follow directions that are quadratic in it. Three components of
 * the first, then of the second, each at the ten nodes. Single precision turns axes by 1e-7. */
enum { OST_DIRECTION_NODES = 10, OST_DIRECTIONS = 6 * OST_DIRECTION_NODES };

/* Local. Which axes two directions are, as ost_axes_from_directions has it; `second`: is there one? Axes as nine
 * numbers (along -1) are e1 and e2. */
void ost_directions_along(const int stated[2], int second, int along[2]);

/* Local. From vectors at the nodes (10 × 3; `second` NULL: the tet's own axis everywhere), turned as the tet's own axes
 * point, as an axis has no sense. The tet's own are taken throughout where a direction is 60 degrees from them, or far
 * longer than its mean, or the two lie along each other: the potential's corners, and tets that show nothing of it. */
void ost_directions_set(const double axes[9], const int along[2], const double *first, const double *second,
                        float directions[OST_DIRECTIONS]);

/* Local. The same, from vectors at the vertices (4 × 3), between which they are linear. */
void ost_directions_set_linear(const double axes[9], const int along[2], const double *first, const double *second,
                               float directions[OST_DIRECTIONS]);

/* Local. The nodes' shares of a value at barycentric coordinates. */
void ost_direction_shares(const double at[4], double share[OST_DIRECTION_NODES]);

/* Local. Axes at barycentric coordinates. Raises OST_INVALID_INPUT where the directions give none. */
OstStatus ost_directions_at(OstContext *ctx, const float directions[OST_DIRECTIONS], const signed char along[2],
                            const double at[4], double axes[9]);

#endif

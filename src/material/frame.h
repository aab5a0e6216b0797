/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_FRAME_H
#define ORTHOSTAT_MATERIAL_FRAME_H

#include "core/small.h"
#include "orthostat/axes.h"

static inline void ost_normalise3(double v[3])
{
    const double length = ost_norm3(v);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* Removes from v its part along the unit vector t; returns the length of the rest. */
static inline double ost_make_orthogonal3(const double t[3], double v[3])
{
    const double along = ost_dot3(t, v);
    for (int i = 0; i < 3; i++)
        v[i] -= along * t[i];
    return ost_norm3(v);
}

/* The first row is a unit vector, the second a direction nearly orthogonal to it: makes the frame orthonormal up to
 * rounding errors, and right-handed. (The second row lost digits if it was nearly parallel to the first before.) */
static inline void ost_complete_frame(double frame[9])
{
    ost_normalise3(frame + 3);
    ost_make_orthogonal3(frame, frame + 3);
    ost_normalise3(frame + 3);
    ost_cross3(frame, frame + 3, frame + 6);
}

/* Local. Axes from a frame (rows axial, radial, tangential) in the order asked for. */
OstStatus ost_frame_in_order(OstContext *ctx, const OstCylindricalDirection order[3], const double frame[9],
                             double axes[9]);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_AXES_H
#define ORTHOSTAT_AXES_H

#include "orthostat/context.h"

OST_API_BEGIN

/* Material axes as a 3×3 row-major array: rows e1, e2, e3, right-handed and orthonormal. */

typedef enum {
    OST_AXES_NONE,        /* not given: world axes */
    OST_AXES_FIXED,       /* three rows */
    OST_AXES_EULER,       /* angles in degrees, intrinsic z-x'-z'' unless another sequence is named */
    OST_AXES_QUATERNION,  /* w x y z */
    OST_AXES_CYLINDRICAL, /* follow an axis: axial, radial, tangential */
    OST_AXES_CURVE,       /* follow a polyline: tangent, normal, binormal */
    OST_AXES_CELLS,       /* nine numbers a tet, from the mesh or a text file */
    OST_AXES_GRADIENT,    /* gradients of two harmonic potentials between named boundaries */
    OST_AXES_FIELD        /* fields of the mesh file: one or two directions, or all nine numbers */
} OstAxesKind;

/* Which direction of the frame each material axis takes. */
typedef enum { OST_AXIAL, OST_RADIAL, OST_TANGENTIAL } OstCylindricalDirection;

/* The frame of CYLINDRICAL: axial along `axis`, radial away from it, tangential = axial × radial. The frame of CURVE,
 * at the nearest point of the polyline: axial its tangent, radial its normal, tangential the binormal. The tangent
 * turns evenly between the vertices' (each the mean of its two segments), so axes vary continuously along the curve.
 * The normal is what of `up` is orthogonal to the tangent; where up is zero it starts as the world axis nearest to
 * orthogonal at the first point, and is carried along with the least turning (defined everywhere).
 * Any order makes right-handed axes: where e1, e2, e3 take an odd permutation of the frame, e3 points the other way
 * (which no orthotropic material can tell). */

/* How the axes of a region are given; plain data, arrays owned by whoever made it. */
typedef struct OstAxesSpec {
    OstAxesKind kind;
    double fixed[9];                  /* FIXED; EULER and QUATERNION are turned into this too */
    double origin[3];                 /* CYLINDRICAL */
    double axis[3];                   /* CYLINDRICAL */
    OstCylindricalDirection order[3]; /* CYLINDRICAL, CURVE: e1, e2, e3 take these, see below */
    int point_count;                  /* CURVE */
    double *points;                   /* CURVE: point_count × 3; closed if the last point is the first */
    double up[3];                     /* CURVE: the normal lies in the plane of tangent and up; zero: least turning */
    char *cells_file;      /* CELLS: text file, nine numbers a line in the mesh file's order; NULL: the mesh's field */
    char *from[2], *to[2]; /* GRADIENT: boundary names at potential 0 and 1; the second may be NULL */
    char *field[2];        /* FIELD: names; the second may be NULL */
    int along[2];          /* GRADIENT, FIELD: the axes (0 to 2) that the two directions are; 0 and 0: e1 and e2. Where
                              there is one direction, the other axes are any two across it */
    int single;            /* 1 + the axis that alone was stated; 0: all were */
} OstAxesSpec;

/* Local. Accepts rows that are orthonormal and right-handed to 1e-6 and makes them so to rounding; raises
 * OST_INVALID_INPUT with `what` and the reason (not finite, not a unit vector, not orthogonal, left-handed). */
OstStatus ost_axes_check(OstContext *ctx, const char *what, double axes[9]);

/* Local. Axes from angles in degrees about a sequence such as "zxz" (lower case: turned frame) or "XYZ" (fixed frame),
 * and from a quaternion w x y z of any length but 0. */
OstStatus ost_axes_from_euler(OstContext *ctx, const char *sequence, const double degrees[3], double axes[9]);
OstStatus ost_axes_from_quaternion(OstContext *ctx, const double quaternion[4], double axes[9]);

/* Local. Do these axes differ from point to point? */
int ost_axes_vary(const OstAxesSpec *spec);

/* Local. Axes at a point, for the kinds given by a formula (FIXED to CURVE). Raises OST_INVALID_INPUT where they are
 * not defined (on the cylinder's axis, where the curve's tangent is parallel to up). */
OstStatus ost_axes_at(OstContext *ctx, const OstAxesSpec *spec, const double point[3], double axes[9]);

/* Local. Axes from one direction, or two: the axis along[0] points along d1, along[1] along what of d2 is orthogonal to
 * it (NULL: across it anywhere). Raises OST_INVALID_INPUT for a direction that is zero or not finite, or parallel ones.
 */
OstStatus ost_axes_from_directions(OstContext *ctx, const int along[2], const double d1[3], const double *d2,
                                   double axes[9]);

/* Local. e1 along g1, e2 along what of g2 is orthogonal to it, e3 = e1 × e2; raises if either is (nearly) zero. */
OstStatus ost_axes_from_gradients(OstContext *ctx, const double g1[3], const double g2[3], double axes[9]);

OST_API_END

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "mesh/hexes.h"

#include <math.h>

/* A sphere's octant is the image of three faces of a cube of n × n × n: the points (i, j, k), 0 to n, with at least one
 * coordinate equal to n. On face f coordinate f is n; its cells step in directions f + 1 and f + 2 (cyclically), which
 * form a right-handed system with the outward radius. */
enum { FACES = 3 };

/* A hex: a square of a face, in a layer of the shell. */
typedef struct Cell {
    int face;
    OstGlobal first, second; /* steps in directions f + 1 and f + 2 */
    OstGlobal layer;
} Cell;

static Cell cell_at(const OstOctantShape *octant, OstGlobal number)
{
    const OstGlobal n = octant->around;
    const OstGlobal square = number / octant->radial;
    return (Cell){(int)(square / (n * n)), square / n % n, square % n, number % octant->radial};
}

/* Points are numbered in lexicographic order. A slice i < n has 2 n + 1 points, on two sides of a square; slice n is a
 * full square. */
static OstGlobal sphere_point(OstGlobal n, const OstGlobal index[3])
{
    if (index[0] == n)
        return n * (2 * n + 1) + index[1] * (n + 1) + index[2];
    return index[0] * (2 * n + 1) + index[1] + (index[1] == n ? index[2] : 0);
}

static void sphere_index(OstGlobal n, OstGlobal point, OstGlobal index[3])
{
    const OstGlobal full = n * (2 * n + 1);
    if (point >= full) {
        index[0] = n;
        index[1] = (point - full) / (n + 1);
        index[2] = (point - full) % (n + 1);
        return;
    }
    const OstGlobal side = point % (2 * n + 1);
    index[0] = point / (2 * n + 1);
    index[1] = side < n ? side : n;
    index[2] = side < n ? n : side - n;
}

static void find_corners(const void *shape, OstGlobal number, OstGlobal corner[HEX_CORNERS])
{
    const OstOctantShape *octant = shape;
    const Cell cell = cell_at(octant, number);
    const OstGlobal n = octant->around;
    for (int c = 0; c < HEX_CORNERS; c++) {
        OstGlobal index[3];
        index[cell.face] = n;
        index[(cell.face + 1) % 3] = cell.first + (c & 1);
        index[(cell.face + 2) % 3] = cell.second + (c >> 1 & 1);
        corner[c] = sphere_point(n, index) * (octant->radial + 1) + cell.layer + (c >> 2 & 1);
    }
}

/* Equal angles along the edges of the cube's faces give squares of nearly equal size on the sphere. */
static void place(const void *shape, OstGlobal node, double x[3])
{
    const OstOctantShape *octant = shape;
    const OstGlobal layers = octant->radial + 1;
    const double radius =
        octant->radii[0] + (octant->radii[1] - octant->radii[0]) * (double)(node % layers) / octant->radial;
    OstGlobal index[3];
    double length = 0.0;
    sphere_index(octant->around, node / layers, index);
    for (int d = 0; d < 3; d++) {
        x[d] = index[d] == octant->around ? 1.0 : tan(M_PI_4 * (double)index[d] / octant->around);
        length += x[d] * x[d];
    }
    for (int d = 0; d < 3; d++)
        x[d] = octant->centre[d] + radius * (x[d] / sqrt(length));
}

enum { INNER, OUTER, XMIN, YMIN, ZMIN, SIDES };
static const char *const side_names[SIDES] = {"inner", "outer", "xmin", "ymin", "zmin"};

static const char *name_side(const void *shape, int side)
{
    (void)shape;
    return side_names[side];
}

/* The ends of `direction` at which the cell lies on the side: directions 0 and 1 are the steps on its face, 2 is
 * outward.
 */
static int find_ends(const void *shape, int side, OstGlobal number, int *direction)
{
    const OstOctantShape *octant = shape;
    const Cell cell = cell_at(octant, number);
    *direction = 2;
    if (side == INNER)
        return cell.layer == 0 ? HEX_LOW : 0;
    if (side == OUTER)
        return cell.layer == octant->radial - 1 ? HEX_HIGH : 0;
    *direction = (side - XMIN - cell.face + 2) % 3; /* the step in x, y or z; 2 for the direction of the face itself */
    return *direction != 2 && (*direction == 0 ? cell.first : cell.second) == 0 ? HEX_LOW : 0;
}

static OstStatus check_shape(OstContext *ctx, const OstOctantShape *octant)
{
    for (int d = 0; d < 3; d++)
        if (!isfinite(octant->centre[d]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "octant: centre has the coordinate %g, expected a finite number",
                             octant->centre[d]);
    if (!isfinite(octant->radii[1]) || !(octant->radii[0] > 0.0) || !(octant->radii[0] < octant->radii[1]))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "octant: radii are [%g, %g], expected 0 < inner < outer",
                         octant->radii[0], octant->radii[1]);
    if (octant->around < 1 || octant->radial < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "octant: %d divisions around and %d radial, expected at least 1 of each", octant->around,
                         octant->radial);
    const double hexes = 3.0 * octant->around * octant->around * ((double)octant->radial + 1.0);
    if (hexes > (double)(INT64_MAX / HEX_CORNERS))
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "octant: 3 x %d x %d x %d cells are more than 64-bit numbers can count", octant->around,
                         octant->around, octant->radial);
    return OST_SUCCESS;
}

OstStatus ost_chunk_create_octant(OstContext *ctx, const OstOctantShape *shape, OstMeshChunk **chunk)
{
    const OstGlobal n = shape->around;
    *chunk = NULL;
    OST_TRY(ost_agree(ctx, check_shape(ctx, shape)));
    const Hexes hexes = {.name = "octant",
                         .region = "shell",
                         .nodes = (FACES * n * n + FACES * n + 1) * (shape->radial + 1),
                         .cells = FACES * n * n * shape->radial,
                         .sides = SIDES,
                         .shape = shape,
                         .place = place,
                         .corners = find_corners,
                         .side_name = name_side,
                         .ends = find_ends};
    return ost_hexes_create_chunk(ctx, &hexes, chunk);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/kuhn.h"

#include <math.h>

/* The octant's sphere is three faces of a cube of n × n × n blown up: its points (i, j, k), 0 to n, have a coordinate
 * equal to n. Face f has those with that coordinate in direction f; its cells step in directions f + 1 and f + 2
 * (cyclically), which with the radius outward is a right-handed system. */
enum { FACES = 3 };

/* A hex: a square of a face, and a layer of the wall. */
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

/* Points in lexicographic order: slices of i < n are the sides of a square, 2 n + 1 points; that of i = n is full. */
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

static void cell_corners(const OstOctantShape *octant, const Cell *cell, OstGlobal corner[KUHN_CORNERS])
{
    const OstGlobal n = octant->around;
    for (int c = 0; c < KUHN_CORNERS; c++) {
        OstGlobal index[3];
        index[cell->face] = n;
        index[(cell->face + 1) % 3] = cell->first + (c & 1);
        index[(cell->face + 2) % 3] = cell->second + (c >> 1 & 1);
        corner[c] = sphere_point(n, index) * (octant->radial + 1) + cell->layer + (c >> 2 & 1);
    }
}

/* Equal angles along the edges of a cube's face make squares of nearly equal size on the sphere. */
static void place(const OstOctantShape *octant, OstGlobal node, double x[3])
{
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

static OstStatus make_nodes(const OstOctantShape *octant, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->coordinates, 3 * (size_t)chunk->node_count));
    for (OstLocal i = 0; i < chunk->node_count; i++)
        place(octant, chunk->first_node + i, chunk->coordinates + 3 * (size_t)i);
    return OST_SUCCESS;
}

static OstStatus make_tets(const OstOctantShape *octant, OstGlobal first_cell, OstLocal cell_count, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_nodes, 4 * (size_t)chunk->tet_count));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_region, chunk->tet_count));
    OstGlobal *node = chunk->tet_nodes;
    for (OstLocal i = 0; i < cell_count; i++) {
        const Cell cell = cell_at(octant, first_cell + i);
        OstGlobal corner[KUHN_CORNERS];
        cell_corners(octant, &cell, corner);
        node = ost_kuhn_tets(corner, node);
    }
    return OST_SUCCESS;
}

enum { INNER, OUTER, XMIN, YMIN, ZMIN, SIDES };
static const char *const side_names[SIDES] = {"inner", "outer", "xmin", "ymin", "zmin"};

/* The direction of a cell in which the side lies at an end of it, or -1. */
static int side_direction(const OstOctantShape *octant, const Cell *cell, int side)
{
    if (side == INNER)
        return cell->layer == 0 ? 2 : -1;
    if (side == OUTER)
        return cell->layer == octant->radial - 1 ? 2 : -1;
    const int direction = (side - XMIN - cell->face + 2) % 3; /* of the steps in x, y or z; 2 for the face's own */
    if (direction == 2)
        return -1;
    return (direction == 0 ? cell->first : cell->second) == 0 ? direction : -1;
}

static OstStatus make_boundary(const OstOctantShape *octant, int side, OstGlobal first_cell, OstLocal cell_count,
                               OstMeshChunk *chunk)
{
    OstBoundary *boundary = &chunk->boundaries[chunk->boundary_count++];
    boundary->dimension = 2;
    boundary->nodes_per_item = 3;
    OST_TRY(ost_copy_string(chunk->ctx, side_names[side], &boundary->name));
    for (OstLocal i = 0; i < cell_count; i++) {
        const Cell cell = cell_at(octant, first_cell + i);
        boundary->count += side_direction(octant, &cell, side) < 0 ? 0 : 2;
    }
    OST_TRY(OST_NEW(chunk->ctx, &boundary->nodes, 3 * (size_t)boundary->count));
    OstGlobal *node = boundary->nodes;
    for (OstLocal i = 0; i < cell_count; i++) {
        const Cell cell = cell_at(octant, first_cell + i);
        const int direction = side_direction(octant, &cell, side);
        OstGlobal corner[KUHN_CORNERS];
        if (direction < 0)
            continue;
        cell_corners(octant, &cell, corner);
        node = ost_kuhn_faces(corner, direction, side == OUTER, node);
    }
    return OST_SUCCESS;
}

static OstStatus fill_chunk(const OstOctantShape *octant, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    const OstGlobal n = octant->around;
    const OstGlobal cells = FACES * n * n * octant->radial;
    OstGlobal first_cell = 0;
    OstLocal cell_count = 0;
    chunk->nodes_per_tet = 4;
    chunk->global_nodes = (FACES * n * n + FACES * n + 1) * (octant->radial + 1);
    chunk->global_tets = cells * KUHN_TETS;
    OST_TRY(ost_kuhn_share(ctx, "octant", "cells", cells, &first_cell, &cell_count));
    OST_TRY(ost_kuhn_share(ctx, "octant", "nodes", chunk->global_nodes, &chunk->first_node, &chunk->node_count));
    chunk->first_tet = first_cell * KUHN_TETS;
    chunk->tet_count = cell_count * KUHN_TETS;
    OST_TRY(make_nodes(octant, chunk));
    OST_TRY(make_tets(octant, first_cell, cell_count, chunk));
    OST_TRY(OST_NEW(ctx, &chunk->regions.name, 1));
    chunk->regions.count = 1;
    OST_TRY(ost_copy_string(ctx, "shell", &chunk->regions.name[0]));
    OST_TRY(OST_NEW(ctx, &chunk->boundaries, SIDES));
    for (int side = 0; side < SIDES; side++)
        OST_TRY(make_boundary(octant, side, first_cell, cell_count, chunk));
    return OST_SUCCESS;
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
    if (hexes > (double)(INT64_MAX / KUHN_CORNERS))
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "octant: 3 x %d x %d x %d cells are more than 64-bit numbers can count", octant->around,
                         octant->around, octant->radial);
    return OST_SUCCESS;
}

OstStatus ost_chunk_create_octant(OstContext *ctx, const OstOctantShape *shape, OstMeshChunk **chunk)
{
    *chunk = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    OstStatus status = check_shape(ctx, shape);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, chunk, 1);
    if (status == OST_SUCCESS) {
        (*chunk)->ctx = ctx;
        status = fill_chunk(shape, *chunk);
    }
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    ost_ledger_leave(ctx);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "formats/vtk/grid.h"
#include "formats/vtkhdf/points.h"

#include <inttypes.h>
#include <string.h>

/* Each piece of a file has its own copy of the points that it uses. Those that pieces share have one number, or, where
 * the file does not number them, bitwise the same place. */

typedef struct Keys {
    OstIndex *index;
    OstLocal *of;     /* key of each point */
    OstGlobal *first; /* of each key: the first point that has it */
    OstGlobal *twin;  /* a second one in one piece, or -1 */
    int *piece;       /* the last piece that has it */
    unsigned char *shared;
} Keys;

static void release(Keys *keys)
{
    ost_index_destroy(&keys->index);
    OST_FREE(keys->of, keys->first, keys->twin, keys->piece, keys->shared);
}

static OstStatus allocate(const OstVtkGrid *grid, Keys *keys)
{
    OST_TRY(ost_index_create(grid->ctx, 3, &keys->index));
    OST_TRY(OST_NEW(grid->ctx, &keys->of, grid->points));
    OST_TRY(OST_NEW(grid->ctx, &keys->first, grid->points));
    OST_TRY(OST_NEW(grid->ctx, &keys->twin, grid->points));
    OST_TRY(OST_NEW(grid->ctx, &keys->piece, grid->points));
    return OST_NEW(grid->ctx, &keys->shared, grid->points);
}

int ost_vtk_numbers_points(const char *name)
{
    for (int n = 1; ost_point_labels[n]; n++)
        if (strcmp(ost_point_labels[n], name) == 0)
            return 1;
    return 0;
}

OstStatus ost_vtk_begin_piece(OstVtkGrid *grid, OstGlobal first_point)
{
    OST_TRY(OST_RESIZE(grid->ctx, &grid->piece_start, grid->piece_count + 1));
    grid->piece_start[grid->piece_count++] = first_point;
    return OST_SUCCESS;
}

/* Numbers of the points over all pieces; NULL if there are none. */
static const double *numbers(const OstVtkGrid *grid)
{
    for (int a = 0; a < grid->array_count; a++) {
        const OstVtkArray *array = &grid->array[a];
        if (array->on_points && array->components == 1 && array->tuples == grid->points &&
            ost_vtk_numbers_points(array->name))
            return array->values;
    }
    return NULL;
}

static void key_of(const OstVtkGrid *grid, const double *number, OstGlobal point, OstGlobal key[3])
{
    double place[3] = {number ? number[point] : 0.0, 0.0, 0.0};
    for (int d = 0; d < 3 && !number; d++)
        place[d] = grid->coordinates[3 * point + d] + 0.0; /* -0 becomes 0 */
    memcpy(key, place, sizeof place);
}

static OstStatus find_keys(const OstVtkGrid *grid, const double *number, Keys *keys)
{
    OstGlobal key[3];
    int piece = 0;
    for (OstGlobal p = 0; p < grid->points; p++) {
        while (piece + 1 < grid->piece_count && p >= grid->piece_start[piece + 1])
            piece++;
        const OstLocal known = keys->index->count;
        OstLocal k = 0;
        key_of(grid, number, p, key);
        OST_TRY(ost_index_place(keys->index, key, &k));
        keys->of[p] = k;
        if (k == known) {
            keys->first[k] = p;
            keys->twin[k] = -1;
        } else if (keys->piece[k] == piece)
            keys->twin[k] = p;
        else
            keys->shared[k] = 1;
        keys->piece[k] = piece;
    }
    return OST_SUCCESS;
}

static OstStatus check(const OstVtkGrid *grid, const double *number, const Keys *keys, OstGlobal point)
{
    const OstLocal k = keys->of[point];
    const OstGlobal first = keys->first[k];
    if (keys->shared[k] && keys->twin[k] >= 0)
        return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                         "%s: point %" PRId64
                         " of a piece is not the only one there with its %s, so it is unknown which "
                         "of them other pieces share; number the points over all pieces (a point array "
                         "GlobalNodeId), or write the file in one piece",
                         grid->path, keys->twin[k], number ? "number" : "place");
    if (memcmp(grid->coordinates + 3 * first, grid->coordinates + 3 * point, 3 * sizeof(double)) != 0 && number)
        return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                         "%s: points %" PRId64 " and %" PRId64
                         " both have the number %.17g, but lie at different places",
                         grid->path, first, point, number[point]);
    return OST_SUCCESS;
}

OstStatus ost_vtk_join_pieces(OstVtkGrid *grid)
{
    Keys keys = {0};
    const double *number = numbers(grid);
    if (grid->piece_count < 2)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(grid->ctx, &grid->same, grid->points);
    OST_THEN(allocate(grid, &keys));
    OST_THEN(find_keys(grid, number, &keys));
    for (OstGlobal p = 0; p < grid->points && status == OST_SUCCESS; p++) {
        const OstLocal k = keys.of[p];
        grid->same[p] = keys.shared[k] ? keys.first[k] : p;
        status = keys.shared[k] ? check(grid, number, &keys, p) : OST_SUCCESS;
    }
    for (OstGlobal i = 0; i < grid->connections && status == OST_SUCCESS; i++)
        if (grid->connectivity[i] < grid->points)
            grid->connectivity[i] = grid->same[grid->connectivity[i]];
    release(&keys);
    return status;
}

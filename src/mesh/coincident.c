/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/coincident.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"
#include "core/small.h"

#include <float.h>
#include <stdlib.h>

/* Points are compared within cubes this many tolerances wide; a point is in each cube within one tolerance of it. */
static const double cube_width = 8.0;
enum { CUBES = 8 };

/* Of the shortest edge: no tet has two vertices this near. */
static const double close_share = 0.01;

/* A point as sent to the rank of one of its cubes. */
typedef struct CubePoint {
    int64_t cube[3];
    OstGlobal number;
    double x[3];
} CubePoint;

typedef struct Answer {
    OstGlobal number, lowest;
} Answer;

static OstStatus find_corner(const OstPoints *points, double corner[3])
{
    for (int d = 0; d < 3; d++) {
        corner[d] = DBL_MAX;
        for (OstLocal i = 0; i < points->count; i++)
            corner[d] = fmin(corner[d], points->coordinates[3 * (size_t)i + (size_t)d]);
    }
    return ost_min(points->ctx, 3, corner);
}

static int rank_of_cube(const int64_t cube[3], int size)
{
    uint64_t hash = 0;
    for (int d = 0; d < 3; d++) {
        hash = (hash ^ (uint64_t)cube[d]) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 29;
    }
    return (int)(hash % (uint64_t)size);
}

/* The cubes within one tolerance of a point: one to eight. */
static int list_cubes(const double x[3], const double corner[3], double tolerance, int64_t cube[CUBES][3])
{
    int64_t range[3][2];
    int count = 0;
    for (int d = 0; d < 3; d++)
        for (int side = 0; side < 2; side++)
            range[d][side] =
                (int64_t)floor((x[d] - corner[d] + (side ? tolerance : -tolerance)) / (cube_width * tolerance));
    for (int c = 0; c < CUBES; c++) {
        int repeated = 0;
        for (int d = 0; d < 3; d++)
            repeated |= (c >> d & 1) && range[d][0] == range[d][1];
        for (int d = 0; d < 3 && !repeated; d++)
            cube[count][d] = range[d][c >> d & 1];
        count += !repeated;
    }
    return count;
}

static OstStatus list_cube_points(const OstPoints *points, const double corner[3], double tolerance, OstLocal *count,
                                  CubePoint **point, int **to)
{
    OstContext *ctx = points->ctx;
    OstGlobal total = 0;
    int64_t cube[CUBES][3];
    for (OstLocal i = 0; i < points->count; i++)
        total += list_cubes(points->coordinates + 3 * (size_t)i, corner, tolerance, cube);
    if (total > INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "one rank has too many vertices to compare; use more ranks");
    OST_TRY(OST_NEW(ctx, point, total));
    OST_TRY(OST_NEW(ctx, to, total));
    *count = 0;
    for (OstLocal i = 0; i < points->count; i++) {
        const double *x = points->coordinates + 3 * (size_t)i;
        const int cubes = list_cubes(x, corner, tolerance, cube);
        for (int c = 0; c < cubes; c++, (*count)++) {
            (*point)[*count] = (CubePoint){{cube[c][0], cube[c][1], cube[c][2]}, points->first + i, {x[0], x[1], x[2]}};
            (*to)[*count] = rank_of_cube(cube[c], ost_size(ctx));
        }
    }
    return OST_SUCCESS;
}

static int compare_cubes(const CubePoint *x, const CubePoint *y)
{
    for (int d = 0; d < 3; d++)
        if (x->cube[d] != y->cube[d])
            return x->cube[d] < y->cube[d] ? -1 : 1;
    return 0;
}

static int compare_points(const void *a, const void *b)
{
    const CubePoint *x = a;
    const CubePoint *y = b;
    const int by_cube = compare_cubes(x, y);
    return by_cube ? by_cube : (x->number > y->number) - (x->number < y->number);
}

static int are_close(const CubePoint *a, const CubePoint *b, double tolerance)
{
    const double d[3] = {a->x[0] - b->x[0], a->x[1] - b->x[1], a->x[2] - b->x[2]};
    return ost_norm3(d) <= tolerance;
}

/* For each point, the point of the lowest number near it in the same cube. */
static OstStatus compare_within_cubes(OstContext *ctx, OstLocal count, CubePoint *point, double tolerance,
                                      OstLocal *answers, Answer **answer)
{
    OST_TRY(OST_NEW(ctx, answer, count));
    if (count > 0)
        qsort(point, (size_t)count, sizeof *point, compare_points);
    OstLocal start = 0;
    for (OstLocal i = 0; i < count; i++) {
        if (compare_cubes(&point[start], &point[i]) != 0)
            start = i;
        OstLocal j = start;
        while (j < i && !are_close(&point[j], &point[i], tolerance))
            j++;
        if (j < i)
            (*answer)[(*answers)++] = (Answer){point[i].number, point[j].number};
    }
    return OST_SUCCESS;
}

static OstStatus take_answers(const OstPoints *points, OstLocal answers, const Answer *answer, OstGlobal *lowest)
{
    OstContext *ctx = points->ctx;
    OstGlobal *end = NULL;
    int *to = NULL;
    OstRoute *route = NULL;
    Answer *arrived = NULL;
    OstStatus status = OST_NEW(ctx, &end, ost_size(ctx));
    OST_THEN(OST_NEW(ctx, &to, answers));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_number_ends(ctx, points->first + points->count, end));
    for (OstLocal i = 0; i < answers; i++)
        to[i] = ost_number_holder(end, ost_size(ctx), answer[i].number);
    OST_TRY_DONE(ost_route_create(ctx, answers, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *answer, answer, (void **)&arrived));
    for (OstLocal i = 0; i < route->receives; i++) {
        OstGlobal *mine = &lowest[arrived[i].number - points->first];
        *mine = arrived[i].lowest < *mine ? arrived[i].lowest : *mine;
    }
done:
    OST_FREE(end, to, arrived);
    ost_route_destroy(&route);
    return status;
}

OstStatus ost_coincident_find(const OstPoints *points, double tolerance, OstGlobal *lowest)
{
    OstContext *ctx = points->ctx;
    double corner[3];
    OstLocal count = 0, answers = 0;
    CubePoint *point = NULL, *arrived = NULL;
    Answer *answer = NULL;
    int *to = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < points->count; i++)
        lowest[i] = points->first + i;
    OST_TRY_DONE(find_corner(points, corner));
    OST_TRY_DONE(ost_agree(ctx, list_cube_points(points, corner, tolerance, &count, &point, &to)));
    OST_TRY_DONE(ost_route_create(ctx, count, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *point, point, (void **)&arrived));
    OST_FREE(point);
    OST_TRY_DONE(ost_agree(ctx, compare_within_cubes(ctx, route->receives, arrived, tolerance, &answers, &answer)));
    OST_TRY_DONE(take_answers(points, answers, answer, lowest));
done:
    OST_FREE(point, arrived, answer, to);
    ost_route_destroy(&route);
    return status;
}

static OstStatus find_shortest_edge(const OstMesh *mesh, double *shortest)
{
    *shortest = DBL_MAX;
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        for (int e = 0; e < 6; e++) {
            const double *a = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]];
            const double *b = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]];
            const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
            *shortest = fmin(*shortest, ost_norm3(d));
        }
    }
    return ost_min(mesh->ctx, 1, shortest);
}

OstStatus ost_mesh_count_coincident(const OstMesh *mesh, const unsigned char *joined, OstGlobal *count,
                                    double *tolerance)
{
    OstContext *ctx = mesh->ctx;
    const OstPoints points = {ctx, mesh->first_node, mesh->owned_nodes, mesh->coordinates};
    double shortest = 0.0;
    OstGlobal *lowest = NULL;
    *count = 0;
    OST_TRY(find_shortest_edge(mesh, &shortest));
    const double digit = pow(10.0, floor(log10(close_share * shortest)));
    *tolerance = digit * floor(close_share * shortest / digit * (1.0 + 4.0 * DBL_EPSILON));
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &lowest, mesh->owned_nodes));
    OST_THEN(ost_coincident_find(&points, *tolerance, lowest));
    for (OstLocal i = 0; i < mesh->owned_nodes && status == OST_SUCCESS; i++)
        *count += lowest[i] != mesh->first_node + i && !(joined && joined[i]);
    OST_FREE(lowest);
    OST_TRY(status);
    return ost_sum_numbers(ctx, 1, count);
}

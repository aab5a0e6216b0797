/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/misfit.h"

#include "core/error.h"
#include "core/hash.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"
#include "core/small.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Faces are compared within cubes, whose width is 2 to 4 times the longest edge of the faces listed in them: a level of
 * cubes for each power of two. A face is listed in all cubes of its level that it may touch, and looked up by its
 * centroid in the cubes of each level with faces of its size or larger. */
enum { LEVELS = 40 };

/* A face lies on another if its centroid is no farther from it than this share of the tets' heights: a plate, or a gap,
 * however thin it is, is then none. Of a quadrilateral that is not plane, the triangles across its two diagonals
 * differ by more. */
static const double near_share = 1e-3, warped_share = 0.3;

/* Cosine of the angle between the normals: back to back. */
static const double opposed = -0.9, warped_opposed = -0.3;

/* Of a face's longest edge: its vertices are those of another face if they are this near. */
static const double same_share = 0.01;

typedef struct Face {
    uint64_t cube; /* the hash of a cube */
    OstGlobal node[3], tet;
    double x[9], normal[3], height; /* of length 1; of the tet over the face */
    OstLocal face;                  /* this rank's */
    int looks;                      /* looked up, or listed */
} Face;

typedef enum { APART, CRACKED, MISFIT } Verdict;

typedef struct Answer {
    Verdict verdict;
    OstGlobal neighbour;
} Answer;

typedef struct Search {
    const OstMesh *mesh;
    const OstSurface *surface;
    double corner[3]; /* the body's lowest */
    int top;          /* the level of the largest face */
    OstGlobal wanted; /* bits of the levels from there down: those that have faces */
    OstLocal count;
    Face *face;
    int *to;
} Search;

/* --- geometry --- */

static void difference(const double *a, const double *b, double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = b[i] - a[i];
}

static double distance(const double *a, const double *b)
{
    double d[3];
    difference(a, b, d);
    return ost_norm3(d);
}

static void centroid_of(const Face *face, double x[3])
{
    for (int d = 0; d < 3; d++)
        x[d] = (face->x[d] + face->x[3 + d] + face->x[6 + d]) / 3.0;
}

static double longest_edge(const Face *face)
{
    return fmax(distance(face->x, face->x + 3),
                fmax(distance(face->x + 3, face->x + 6), distance(face->x + 6, face->x)));
}

/* Is a point over the triangle, or on its rim? */
static int is_over(const Face *face, const double x[3])
{
    const double size = longest_edge(face), least = -1e-6 * size * size;
    for (int v = 0; v < 3; v++) {
        double along[3], to[3], cross[3];
        difference(face->x + 3 * v, face->x + 3 * ((v + 1) % 3), along);
        difference(face->x + 3 * v, x, to);
        ost_cross3(along, to, cross);
        if (ost_dot3(cross, face->normal) < least)
            return 0;
    }
    return 1;
}

static int has_node(const Face *face, OstGlobal node)
{
    return face->node[0] == node || face->node[1] == node || face->node[2] == node;
}

static int common_nodes(const Face *a, const Face *b)
{
    return has_node(a, b->node[0]) + has_node(a, b->node[1]) + has_node(a, b->node[2]);
}

static int same_places(const Face *a, const Face *b)
{
    const double near = same_share * longest_edge(a);
    for (int i = 0; i < 3; i++) {
        const double *x = a->x + 3 * i;
        if (!(distance(x, b->x) <= near || distance(x, b->x + 3) <= near || distance(x, b->x + 6) <= near))
            return 0;
    }
    return 1;
}

/* Are these the triangles across the two diagonals of a quadrilateral? A third face of its vertices is listed too. */
static int across_diagonals(const Face *a, const Face *b, OstLocal count, const Face *listed)
{
    if (common_nodes(a, b) != 2)
        return 0;
    for (OstLocal i = 0; i < count; i++) {
        const Face *other = &listed[i];
        int among = 0;
        for (int v = 0; v < 3; v++)
            among += has_node(a, other->node[v]) || has_node(b, other->node[v]);
        if (among == 3 && common_nodes(a, other) == 2 && common_nodes(b, other) == 2)
            return 1;
    }
    return 0;
}

/* How a face lies to one of the faces listed with it. */
static Verdict compare(const Face *face, const Face *other, OstLocal count, const Face *listed)
{
    double x[3], to[3];
    const double cosine = ost_dot3(face->normal, other->normal);
    if (!(cosine < warped_opposed) || common_nodes(face, other) == 3)
        return APART;
    centroid_of(face, x);
    difference(other->x, x, to);
    const double off = fabs(ost_dot3(to, other->normal)), height = fmin(face->height, other->height);
    if (!(off <= warped_share * height) || !is_over(other, x))
        return APART;
    if (cosine < opposed && off <= near_share * height)
        return same_places(face, other) ? CRACKED : MISFIT;
    return across_diagonals(face, other, count, listed) ? MISFIT : APART;
}

/* --- cubes --- */

static int level_of(double size)
{
    int exponent;
    frexp(size, &exponent);
    return exponent;
}

static double width_of(int level)
{
    return ldexp(2.0, level);
}

static int64_t place_of(const Search *search, int d, double x, double width)
{
    return (int64_t)floor((x - search->corner[d]) / width);
}

static uint64_t hash_of(int level, const int64_t cube[3])
{
    const int64_t key[4] = {level, cube[0], cube[1], cube[2]};
    return ost_hash(OST_HASH_START, sizeof key, key);
}

static OstStatus add(Search *search, const Face *face, uint64_t cube, int looks)
{
    OstContext *ctx = search->mesh->ctx;
    if (search->count == INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "one rank has too many surface faces; use more ranks");
    OST_TRY(OST_GROW(ctx, &search->face, (size_t)search->count + 1));
    OST_TRY(OST_GROW(ctx, &search->to, (size_t)search->count + 1));
    Face *added = &search->face[search->count];
    *added = *face;
    added->cube = cube;
    added->looks = looks;
    search->to[search->count++] = (int)((cube >> 20) % (uint64_t)ost_size(ctx));
    return OST_SUCCESS;
}

/* In the cubes that a face may touch: one to eight. */
static OstStatus list_face(Search *search, const Face *face, int level)
{
    const double width = width_of(level), margin = 0.01 * width;
    int64_t low[3], high[3], cube[3];
    for (int d = 0; d < 3; d++) {
        const double *x = face->x + d;
        low[d] = place_of(search, d, fmin(x[0], fmin(x[3], x[6])) - margin, width);
        high[d] = place_of(search, d, fmax(x[0], fmax(x[3], x[6])) + margin, width);
    }
    for (cube[0] = low[0]; cube[0] <= high[0]; cube[0]++)
        for (cube[1] = low[1]; cube[1] <= high[1]; cube[1]++)
            for (cube[2] = low[2]; cube[2] <= high[2]; cube[2]++)
                OST_TRY(add(search, face, hash_of(level, cube), 0));
    return OST_SUCCESS;
}

static OstStatus look_up_face(Search *search, const Face *face, int own)
{
    double x[3];
    centroid_of(face, x);
    for (int level = search->top; level >= own - 1 && level > search->top - LEVELS; level--) {
        int64_t cube[3];
        if (!(search->wanted >> (search->top - level) & 1))
            continue;
        for (int d = 0; d < 3; d++)
            cube[d] = place_of(search, d, x[d], width_of(level));
        OST_TRY(add(search, face, hash_of(level, cube), 1));
    }
    return OST_SUCCESS;
}

static void get_face(const Search *search, OstLocal number, Face *face)
{
    const OstMesh *mesh = search->mesh;
    const OstLocal *node = search->surface->nodes + (size_t)number * (size_t)search->surface->nodes_per_face;
    const OstLocal tet = search->surface->tet[number];
    double side[2][3], area;
    *face = (Face){.face = number, .tet = ost_mesh_tet_number(mesh, tet)};
    for (int v = 0; v < 3; v++) {
        face->node[v] = mesh->node_number[node[v]];
        memcpy(face->x + 3 * v, mesh->coordinates + 3 * (size_t)node[v], 3 * sizeof *face->x);
    }
    difference(face->x, face->x + 3, side[0]);
    difference(face->x, face->x + 6, side[1]);
    ost_cross3(side[0], side[1], face->normal);
    area = ost_norm3(face->normal);
    for (int d = 0; d < 3; d++)
        face->normal[d] /= area;
    face->height = 6.0 * ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet)) / area;
}

/* Does this rank compare the face? */
static int is_mine(const Search *search, OstLocal number, const unsigned char *joined)
{
    const OstLocal *node = search->surface->nodes + (size_t)number * (size_t)search->surface->nodes_per_face;
    const OstGlobal corner[3] = {node[0], node[1], node[2]};
    int all = joined != NULL;
    for (int v = 0; v < 3 && all; v++)
        all = joined[node[v]];
    return !all && ost_mesh_owns(search->mesh, 3, corner);
}

static OstStatus find_levels(Search *search, const unsigned char *joined)
{
    OstContext *ctx = search->mesh->ctx;
    Face face;
    double largest = 0.0;
    OstGlobal has[LEVELS] = {0};
    for (OstLocal f = 0; f < search->surface->count; f++) {
        get_face(search, f, &face);
        largest = fmax(largest, longest_edge(&face));
    }
    OST_TRY(ost_max(ctx, 1, &largest));
    search->top = level_of(largest);
    for (OstLocal f = 0; f < search->surface->count; f++) {
        get_face(search, f, &face);
        const int below = search->top - level_of(longest_edge(&face));
        if (below < LEVELS && is_mine(search, f, joined))
            has[below] = 1;
    }
    OST_TRY(ost_max_numbers(ctx, LEVELS, has));
    for (int i = 0; i < LEVELS; i++)
        search->wanted |= has[i] << i;
    return OST_SUCCESS;
}

static OstStatus list_all(Search *search, const unsigned char *joined)
{
    Face face;
    const size_t expected = 3 * (size_t)search->surface->count + 64;
    OST_TRY(OST_NEW(search->mesh->ctx, &search->face, expected));
    OST_TRY(OST_NEW(search->mesh->ctx, &search->to, expected));
    for (OstLocal f = 0; f < search->surface->count; f++) {
        if (!is_mine(search, f, joined))
            continue;
        get_face(search, f, &face);
        const int level = level_of(longest_edge(&face));
        if (level <= search->top - LEVELS)
            continue;
        OST_TRY(list_face(search, &face, level));
        OST_TRY(look_up_face(search, &face, level));
    }
    return OST_SUCCESS;
}

/* --- the search --- */

/* What arrived, by cube, those listed first. */
typedef struct Key {
    uint64_t cube;
    OstLocal place;
    int looks;
} Key;

static int compare_keys(const void *a, const void *b)
{
    const Key *x = a, *y = b;
    if (x->cube != y->cube)
        return x->cube < y->cube ? -1 : 1;
    return x->looks != y->looks ? x->looks - y->looks : (x->place > y->place) - (x->place < y->place);
}

/* The answer for a face that is looked up among those listed in its cube. */
static Answer look_up(const Face *face, OstLocal count, const Face *listed)
{
    Answer answer = {APART, INT64_MAX};
    for (OstLocal i = 0; i < count; i++) {
        const Verdict verdict = compare(face, &listed[i], count, listed);
        if (verdict == MISFIT && listed[i].tet < answer.neighbour)
            answer.neighbour = listed[i].tet;
        answer.verdict = verdict > answer.verdict ? verdict : answer.verdict;
    }
    return answer;
}

/* The most that are listed in one cube. */
static OstLocal most_listed(OstLocal count, const Key *key)
{
    OstLocal most = 0;
    for (OstLocal i = 0, found = 0; i < count; i++) {
        found = i > 0 && key[i - 1].cube == key[i].cube ? found : 0;
        found += !key[i].looks;
        most = found > most ? found : most;
    }
    return most;
}

static OstStatus look_up_all(OstContext *ctx, OstLocal count, const Face *arrived, Answer *answer)
{
    Key *key = NULL;
    Face *listed = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &key, count));
    for (OstLocal i = 0; i < count; i++)
        key[i] = (Key){arrived[i].cube, i, arrived[i].looks};
    if (count > 0)
        qsort(key, (size_t)count, sizeof *key, compare_keys);
    OST_TRY_DONE(OST_NEW(ctx, &listed, most_listed(count, key)));
    OstLocal found = 0;
    for (OstLocal i = 0; i < count; i++) {
        if (i == 0 || key[i - 1].cube != key[i].cube)
            found = 0;
        if (key[i].looks)
            answer[key[i].place] = look_up(&arrived[key[i].place], found, listed);
        else
            listed[found++] = arrived[key[i].place];
    }
done:
    OST_FREE(key, listed);
    return status;
}

/* A face is looked up on several levels: the worst of its answers counts. */
static OstStatus take_answers(const Search *search, const Answer *answer, OstMisfits *misfits)
{
    OstContext *ctx = search->mesh->ctx;
    Answer *worst = NULL;
    OST_TRY(OST_NEW(ctx, &worst, search->surface->count));
    for (OstLocal i = 0; i < search->count; i++) {
        Answer *of_face = &worst[search->face[i].face];
        if (search->face[i].looks && answer[i].verdict > of_face->verdict)
            *of_face = answer[i];
    }
    for (OstLocal f = 0; f < search->surface->count; f++) {
        Face face;
        misfits->cracked += worst[f].verdict == CRACKED;
        if (worst[f].verdict != MISFIT)
            continue;
        get_face(search, f, &face);
        misfits->faces++;
        for (int k = 0; k < 9; k++) {
            misfits->low[k % 3] = fmin(misfits->low[k % 3], face.x[k]);
            misfits->high[k % 3] = fmax(misfits->high[k % 3], face.x[k]);
        }
        if (face.tet < misfits->tet) {
            misfits->tet = face.tet;
            misfits->neighbour = worst[f].neighbour;
        }
    }
    OST_FREE(worst);
    return OST_SUCCESS;
}

static OstStatus reduce(OstContext *ctx, OstMisfits *misfits)
{
    const OstGlobal mine = misfits->tet;
    OstGlobal count[2] = {misfits->cracked, misfits->faces};
    OST_TRY(ost_sum_numbers(ctx, 2, count));
    misfits->cracked = count[0];
    misfits->faces = count[1];
    OST_TRY(ost_min(ctx, 3, misfits->low));
    OST_TRY(ost_max(ctx, 3, misfits->high));
    OST_TRY(ost_min_numbers(ctx, 1, &misfits->tet));
    misfits->neighbour = misfits->tet == mine ? misfits->neighbour : INT64_MAX;
    return ost_min_numbers(ctx, 1, &misfits->neighbour);
}

static OstStatus find(Search *search, const unsigned char *joined, OstMisfits *misfits)
{
    OstContext *ctx = search->mesh->ctx;
    double high[3];
    void *arrived = NULL;
    Answer *answers = NULL, *mine = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_mesh_bounds(search->mesh, search->corner, high));
    OST_TRY_DONE(ost_mesh_surface(search->mesh, &search->surface));
    OST_TRY_DONE(find_levels(search, joined));
    OST_TRY_DONE(ost_agree(ctx, list_all(search, joined)));
    OST_TRY_DONE(ost_route_create(ctx, search->count, 1, search->to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *search->face, search->face, &arrived));
    status = OST_NEW(ctx, &answers, route->receives);
    OST_THEN(OST_NEW(ctx, &mine, search->count));
    OST_THEN(look_up_all(ctx, route->receives, arrived, answers));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_route_answer(route, sizeof *answers, answers, mine));
    OST_TRY_DONE(ost_agree(ctx, take_answers(search, mine, misfits)));
    OST_TRY_DONE(reduce(ctx, misfits));
done:
    OST_FREE(arrived, answers, mine);
    ost_route_destroy(&route);
    return status;
}

OstStatus ost_mesh_find_misfits(const OstMesh *mesh, const unsigned char *joined, OstMisfits *misfits)
{
    Search search = {.mesh = mesh};
    *misfits = (OstMisfits){.low = {DBL_MAX, DBL_MAX, DBL_MAX},
                            .high = {-DBL_MAX, -DBL_MAX, -DBL_MAX},
                            .tet = INT64_MAX,
                            .neighbour = INT64_MAX};
    const OstStatus status = find(&search, joined, misfits);
    OST_FREE(search.face, search.to);
    return status;
}

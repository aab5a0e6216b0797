/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/flat/stacks.h"

#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

/* An edge is short if it is no longer than this share of the longest edge of each of its tets. */
static const double short_share = 0.4;

/* Vertices of a place. */
enum { MOST_OF_PLACE = 3 };

void ost_stacks_destroy(OstStacks **stacks)
{
    if (!*stacks)
        return;
    OST_FREE((*stacks)->start, (*stacks)->function, (*stacks)->stack, (*stacks)->place, (*stacks)->block);
    OST_FREE((*stacks)->factor);
    OST_FREE(*stacks);
}

static double edge_square(const OstMesh *mesh, OstLocal a, OstLocal b)
{
    double square = 0.0;
    for (size_t i = 0; i < 3; i++) {
        const double side = mesh->coordinates[3 * (size_t)a + i] - mesh->coordinates[3 * (size_t)b + i];
        square += side * side;
    }
    return square;
}

/* 1 for edges that are not short. */
static void mark_long(const OstComplement *complement, unsigned char *is_long)
{
    const OstMesh *mesh = complement->mesh;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *node = ost_mesh_nodes_of(mesh, tet);
        double square[6], longest = 0.0;
        for (int e = 0; e < 6; e++) {
            square[e] = edge_square(mesh, node[ost_tet_edge[e][0]], node[ost_tet_edge[e][1]]);
            longest = square[e] > longest ? square[e] : longest;
        }
        int count = 0;
        for (int e = 0; e < 6; e++)
            count += square[e] <= short_share * short_share * longest;
        for (int e = 0; e < 6; e++)
            if (count > 1 || square[e] > short_share * short_share * longest)
                is_long[complement->edges.of_tet[6 * (size_t)tet + (size_t)e]] = 1;
    }
}

static OstLocal find_place(OstLocal *leader, OstLocal vertex)
{
    while (leader[vertex] != vertex)
        vertex = leader[vertex] = leader[leader[vertex]];
    return vertex;
}

/* place: of each vertex, one of its vertices */
static OstStatus find_places(const OstComplement *complement, OstLocal *place)
{
    const OstMesh *mesh = complement->mesh;
    unsigned char *is_long = NULL;
    int *size = NULL;
    OstStatus status = OST_NEW(mesh->ctx, &is_long, complement->edges.count);
    OST_THEN(OST_NEW(mesh->ctx, &size, mesh->node_count));
    if (status == OST_SUCCESS)
        mark_long(complement, is_long);
    for (OstLocal v = 0; v < mesh->node_count && status == OST_SUCCESS; v++) {
        place[v] = v;
        size[v] = 1;
    }
    for (OstLocal e = 0; e < complement->edges.count && status == OST_SUCCESS; e++) {
        const OstLocal a = find_place(place, complement->edges.low[e]),
                       b = find_place(place, complement->edges.high[e]);
        if (is_long[e] || a == b || size[a] + size[b] > MOST_OF_PLACE)
            continue;
        place[b] = a;
        size[a] += size[b];
    }
    for (OstLocal v = 0; v < mesh->node_count && status == OST_SUCCESS; v++)
        place[v] = find_place(place, v);
    OST_FREE(is_long);
    OST_FREE(size);
    return status;
}

/* A function with its places, ascending; one that it has twice counts once, and -1 fills up. */
typedef struct Keyed {
    OstLocal place[3], function;
} Keyed;

static void sort_places(OstLocal place[3])
{
    static const int pair[3][2] = {{0, 1}, {1, 2}, {0, 1}};
    for (int k = 0; k < 3; k++) {
        OstLocal *a = &place[pair[k][0]], *b = &place[pair[k][1]], low = *a < *b ? *a : *b;
        *b = *a < *b ? *b : *a;
        *a = low;
    }
}

static Keyed key_of(const OstComplement *complement, const OstLocal *place, OstLocal function)
{
    const EdgeTable *edges = &complement->edges;
    const OstLocal face = function - edges->count;
    Keyed keyed = {{-1, -1, -1}, function};
    OstLocal edge = function;
    if (face >= 0) { /* listed at an edge: the last that starts no later */
        OstLocal low = 0, high = edges->count;
        while (high - low > 1) {
            const OstLocal middle = low + (high - low) / 2;
            *(complement->faces.start[middle] <= face ? &low : &high) = middle;
        }
        edge = low;
        keyed.place[2] = place[complement->faces.high[face]];
    }
    keyed.place[0] = place[edges->low[edge]];
    keyed.place[1] = place[edges->high[edge]];
    if (keyed.place[1] == keyed.place[0])
        keyed.place[1] = -1;
    if (keyed.place[2] == keyed.place[0] || keyed.place[2] == keyed.place[1])
        keyed.place[2] = -1;
    sort_places(keyed.place);
    return keyed;
}

static int compare_keys(const void *a, const void *b)
{
    const Keyed *one = a, *other = b;
    const int order = memcmp(one->place, other->place, sizeof one->place);
    return order != 0 ? order : (one->function > other->function) - (one->function < other->function);
}

/* Stacks from functions that are sorted by their places. */
static OstStatus fill(const Keyed *keyed, OstLocal owned, OstStacks *stacks)
{
    OstContext *ctx = stacks->complement->mesh->ctx;
    for (OstLocal k = 0; k < owned; k++) {
        const OstLocal size = k - (stacks->count > 0 ? stacks->start[stacks->count - 1] : 0);
        const int is_next =
            k == 0 || size == OST_MOST_OF_STACK || memcmp(keyed[k].place, keyed[k - 1].place, sizeof keyed->place) != 0;
        if (is_next)
            stacks->start[stacks->count++] = k;
        stacks->function[k] = keyed[k].function;
        stacks->stack[keyed[k].function] = stacks->count - 1;
        stacks->place[keyed[k].function] = (int)(k - stacks->start[stacks->count - 1]);
    }
    stacks->start[stacks->count] = owned;
    OST_TRY(OST_NEW(ctx, &stacks->block, (size_t)stacks->count + 1));
    for (OstLocal s = 0; s < stacks->count; s++) {
        const size_t n = 3 * (size_t)(stacks->start[s + 1] - stacks->start[s]);
        stacks->block[s + 1] = stacks->block[s] + n * (n + 1) / 2;
    }
    return OST_NEW(ctx, &stacks->factor, stacks->block[stacks->count]);
}

static OstStatus build(const OstComplement *complement, OstStacks *stacks)
{
    OstContext *ctx = complement->mesh->ctx;
    const OstLocal owned = complement->owned_edges + complement->owned_faces;
    OstLocal *place = NULL, count = 0;
    Keyed *keyed = NULL;
    *stacks = (OstStacks){.complement = complement};
    OstStatus status = OST_NEW(ctx, &place, complement->mesh->node_count);
    OST_THEN(OST_NEW(ctx, &keyed, owned));
    OST_THEN(OST_NEW(ctx, &stacks->start, (size_t)owned + 1));
    OST_THEN(OST_NEW(ctx, &stacks->function, owned));
    OST_THEN(OST_NEW(ctx, &stacks->stack, complement->count));
    OST_THEN(OST_NEW(ctx, &stacks->place, complement->count));
    OST_THEN(find_places(complement, place));
    for (OstLocal k = 0; k < complement->count && status == OST_SUCCESS; k++) {
        stacks->stack[k] = -1;
        if (ost_complement_owns(complement, k))
            keyed[count++] = key_of(complement, place, k);
    }
    if (status == OST_SUCCESS && count > 0)
        qsort(keyed, (size_t)count, sizeof *keyed, compare_keys);
    OST_THEN(fill(keyed, count, stacks));
    OST_FREE(place);
    OST_FREE(keyed);
    return status;
}

OstStatus ost_stacks_create(const OstComplement *complement, OstStacks **stacks)
{
    OST_TRY(OST_NEW(complement->mesh->ctx, stacks, 1));
    const OstStatus status = build(complement, *stacks);
    if (status != OST_SUCCESS)
        ost_stacks_destroy(stacks);
    return status;
}

/* y = N r of one stack, and z = N'y; returns y'y. */
static inline float apply_one(size_t n, const float *column, const float *r, float *z)
{
    float y[3 * OST_MOST_OF_STACK] = {0.0F}, square = 0.0F;
    const float *start = column;
    for (size_t j = 0; j < n; column += n - j, j++)
        for (size_t i = j; i < n; i++)
            y[i] += column[i - j] * r[j];
    column = start;
    for (size_t j = 0; j < n; column += n - j, j++) {
        float sum = 0.0F;
        for (size_t i = j; i < n; i++)
            sum += column[i - j] * y[i];
        z[j] = sum;
        square += y[j] * y[j];
    }
    return square;
}

OST_KERNEL double ost_stacks_apply(const OstStacks *stacks, const float *r, float *z)
{
    const OstComplement *complement = stacks->complement;
    double product = 0.0;
    memset(z, 0, OST_PER_FUNCTION * (size_t)complement->count * sizeof *z);
    for (OstLocal s = 0; s < stacks->count; s++) {
        const OstLocal *function = stacks->function + stacks->start[s];
        const size_t size = (size_t)(stacks->start[s + 1] - stacks->start[s]);
        float of_r[3 * OST_MOST_OF_STACK], of_z[3 * OST_MOST_OF_STACK];
        for (size_t k = 0; k < size; k++)
            memcpy(of_r + 3 * k, r + OST_PER_FUNCTION * (size_t)function[k], 3 * sizeof *r);
        product += (double)apply_one(3 * size, stacks->factor + stacks->block[s], of_r, of_z);
        for (size_t k = 0; k < size; k++)
            memcpy(z + OST_PER_FUNCTION * (size_t)function[k], of_z + 3 * k, 3 * sizeof *z);
    }
    return product;
}

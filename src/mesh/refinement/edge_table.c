/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/refinement/mid_nodes.h"

void ost_edge_table_clear(EdgeTable *table)
{
    OST_FREE(table->start, table->low, table->high, table->of_tet);
    table->count = 0;
}

static void sort_ends(const OstMesh *mesh, OstLocal a, OstLocal b, OstLocal *low, OstLocal *high)
{
    const int ascending = mesh->node_number[a] < mesh->node_number[b];
    *low = ascending ? a : b;
    *high = ascending ? b : a;
}

/* The place of the first of some ascending numbers that is not below one. (bsearch and qsort call a function for each
 * comparison, which took most of the time here.) */
static OstLocal place_of(OstLocal number, const OstLocal *ascending, OstLocal count)
{
    OstLocal first = 0;
    for (OstLocal left = count; left > 0;) {
        const OstLocal half = left / 2;
        const int below = ascending[first + half] < number;
        first += below ? half + 1 : 0;
        left = below ? left - half - 1 : half;
    }
    return first;
}

OstLocal ost_edge_find(const EdgeTable *table, const OstMesh *mesh, OstLocal a, OstLocal b)
{
    OstLocal low = 0;
    OstLocal high = 0;
    sort_ends(mesh, a, b, &low, &high);
    const OstLocal first = table->start[low], count = table->start[low + 1] - first;
    const OstLocal place = place_of(high, table->high + first, count);
    return place < count && table->high[first + place] == high ? first + place : -1;
}

/* --- a table --- */

/* An edge of a tet, listed at its low end. */
typedef struct Side {
    OstLocal high;
    uint32_t place; /* in EdgeTable.of_tet */
} Side;

static void side_of(const OstMesh *mesh, OstLocal tet, int edge, OstLocal *low, Side *side)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    sort_ends(mesh, nodes[ost_tet_edge[edge][0]], nodes[ost_tet_edge[edge][1]], low, &side->high);
    side->place = 6 * (uint32_t)tet + (uint32_t)edge;
}

/* Lists the sides of each low end: those of n start at start[n]. */
static OstStatus list_sides(const OstMesh *mesh, OstGlobal *start, Side **side)
{
    OstGlobal *next = start + 1; /* offset by one: filling the lists moves each start to its place */
    OstLocal low = 0;
    Side one;
    if ((uint32_t)mesh->tet_count > UINT32_MAX / 6)
        return OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED,
                         "a rank would number the edges of %d tets, more than %u; use more ranks", mesh->tet_count,
                         UINT32_MAX / 6);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int e = 0; e < 6; e++) {
            side_of(mesh, t, e, &low, &one);
            next[low + 1]++;
        }
    }
    for (OstLocal n = 0; n < mesh->node_count; n++)
        next[n + 1] += next[n];
    OST_TRY(OST_NEW(mesh->ctx, side, next[mesh->node_count]));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int e = 0; e < 6; e++) {
            side_of(mesh, t, e, &low, &one);
            (*side)[next[low]++] = one;
        }
    }
    return OST_SUCCESS;
}

/* Adds a number to ascending ones, after which there is room. */
static void insert(OstLocal number, OstLocal *ascending, OstLocal count)
{
    OstLocal place = count;
    for (; place > 0 && ascending[place - 1] > number; place--)
        ascending[place] = ascending[place - 1];
    ascending[place] = number;
}

static OstStatus make_room(const OstMesh *mesh, OstGlobal edges, EdgeTable *table)
{
    if (edges > INT32_MAX)
        return OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED,
                         "a rank would hold more than the %d mid-edge nodes it can number; use more ranks", INT32_MAX);
    OST_TRY(OST_GROW(mesh->ctx, &table->low, edges));
    return OST_GROW(mesh->ctx, &table->high, edges);
}

/* Numbers the edges, those of one low end after those of the one before. edge_to: node_count zeros. */
static OstStatus number_sides(const OstMesh *mesh, const OstGlobal *start, const Side *side, OstLocal *edge_to,
                              EdgeTable *table)
{
    OST_TRY(make_room(mesh, mesh->tet_count + (OstGlobal)mesh->node_count, table));
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        const OstLocal first = table->count;
        OST_TRY(make_room(mesh, first + start[n + 1] - start[n], table));
        for (OstGlobal i = start[n]; i < start[n + 1]; i++) {
            OstLocal *edge = &edge_to[side[i].high]; /* plus 1; not above `first`: of another low end */
            if (*edge <= first) {
                *edge = first + 1;
                insert(side[i].high, table->high + first, table->count++ - first);
            }
        }
        for (OstLocal e = first; e < table->count; e++) {
            table->low[e] = n;
            edge_to[table->high[e]] = e + 1;
        }
        for (OstGlobal i = start[n]; i < start[n + 1]; i++)
            table->of_tet[side[i].place] = edge_to[side[i].high] - 1;
        table->start[n + 1] = table->count;
    }
    OST_TRY(OST_RESIZE(mesh->ctx, &table->low, table->count));
    return OST_RESIZE(mesh->ctx, &table->high, table->count);
}

OstStatus ost_edge_table_build(const OstMesh *mesh, EdgeTable *table)
{
    OstGlobal *start = NULL;
    Side *side = NULL;
    OstLocal *edge_to = NULL;
    OstStatus status = OST_NEW(mesh->ctx, &start, (size_t)mesh->node_count + 2);
    OST_THEN(OST_NEW(mesh->ctx, &edge_to, mesh->node_count));
    OST_THEN(OST_NEW(mesh->ctx, &table->start, (size_t)mesh->node_count + 1));
    OST_THEN(OST_NEW(mesh->ctx, &table->of_tet, 6 * (size_t)mesh->tet_count));
    OST_THEN(list_sides(mesh, start, &side));
    OST_THEN(number_sides(mesh, start, side, edge_to, table));
    OST_FREE(start, edge_to, side);
    return status;
}

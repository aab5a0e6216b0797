/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/refinement/mid_nodes.h"

#include <string.h>

void ost_edge_table_clear(EdgeTable *table)
{
    OST_FREE(table->start);
    OST_FREE(table->low);
    OST_FREE(table->high);
    OST_FREE(table->of_tet);
    table->count = 0;
}

static void sort_ends(const OstMesh *mesh, OstLocal a, OstLocal b, OstLocal *low, OstLocal *high)
{
    const int ascending = mesh->node_number[a] < mesh->node_number[b];
    *low = ascending ? a : b;
    *high = ascending ? b : a;
}

static void edge_ends(const OstMesh *mesh, OstLocal tet, int edge, OstLocal *low, OstLocal *high)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    sort_ends(mesh, nodes[ost_tet_edge[edge][0]], nodes[ost_tet_edge[edge][1]], low, high);
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

/* Lists the high ends of the edges of each low end, once for every tet with the edge. */
static OstStatus list_high_ends(const OstMesh *mesh, OstGlobal *start, OstLocal **high_end)
{
    OstGlobal *next = start + 1; /* offset by one: filling the lists moves each start to its place */
    OstLocal low = 0;
    OstLocal high = 0;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int e = 0; e < 6; e++) {
            edge_ends(mesh, t, e, &low, &high);
            next[low + 1]++;
        }
    }
    for (OstLocal n = 0; n < mesh->node_count; n++)
        next[n + 1] += next[n];
    OST_TRY(OST_NEW(mesh->ctx, high_end, next[mesh->node_count]));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int e = 0; e < 6; e++) {
            edge_ends(mesh, t, e, &low, &high);
            (*high_end)[next[low]++] = high;
        }
    }
    return OST_SUCCESS;
}

/* Adds a number to ascending ones, after which there is room, unless it is there; returns how many there are then. */
static OstLocal insert(OstLocal number, OstLocal *ascending, OstLocal count)
{
    const OstLocal place = place_of(number, ascending, count);
    if (place < count && ascending[place] == number)
        return count;
    memmove(ascending + place + 1, ascending + place, (size_t)(count - place) * sizeof *ascending);
    ascending[place] = number;
    return count + 1;
}

/* Sorts each node's high ends and removes repetitions, in place. */
static OstStatus remove_repetitions(const OstMesh *mesh, const OstGlobal *start, OstLocal *high_end, EdgeTable *table)
{
    OstGlobal kept = 0;
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        OstLocal count = 0;
        for (OstGlobal i = start[n]; i < start[n + 1]; i++)
            count = insert(high_end[i], high_end + kept, count);
        kept += count;
        if (kept > INT32_MAX)
            return OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED,
                             "a rank would hold more than the %d mid-edge nodes it can number; use more ranks",
                             INT32_MAX);
        table->start[n + 1] = (OstLocal)kept;
    }
    table->count = (OstLocal)kept;
    return OST_SUCCESS;
}

static OstStatus file_edges(const OstMesh *mesh, EdgeTable *table)
{
    OstGlobal *start = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(mesh->ctx, &start, (size_t)mesh->node_count + 2));
    OST_TRY_DONE(OST_NEW(mesh->ctx, &table->start, (size_t)mesh->node_count + 1));
    OST_TRY_DONE(list_high_ends(mesh, start, &table->high));
    OST_TRY_DONE(remove_repetitions(mesh, start, table->high, table));
    OST_TRY_DONE(OST_RESIZE(mesh->ctx, &table->high, table->count));
done:
    OST_FREE(start);
    return status;
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

OstStatus ost_edge_table_build(const OstMesh *mesh, EdgeTable *table)
{
    OST_TRY(file_edges(mesh, table));
    OST_TRY(OST_NEW(mesh->ctx, &table->low, table->count));
    OST_TRY(OST_NEW(mesh->ctx, &table->of_tet, 6 * (size_t)mesh->tet_count));
    for (OstLocal n = 0; n < mesh->node_count; n++)
        for (OstLocal e = table->start[n]; e < table->start[n + 1]; e++)
            table->low[e] = n;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        for (int e = 0; e < 6; e++)
            table->of_tet[6 * (size_t)t + (size_t)e] =
                ost_edge_find(table, mesh, nodes[ost_tet_edge[e][0]], nodes[ost_tet_edge[e][1]]);
    }
    return OST_SUCCESS;
}

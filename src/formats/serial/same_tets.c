/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/chunk_tidy.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A tet in several physical volumes comes once for each. A group is often a part of another ("all"), so the one with
 * the fewest tets says most. */

/* A tet's vertices in ascending order, and which tet it is. */
typedef struct VertexSet {
    OstLocal vertex[4];
    OstLocal tet;
} VertexSet;

static int compare_vertices(const VertexSet *x, const VertexSet *y)
{
    for (int i = 0; i < 4; i++)
        if (x->vertex[i] != y->vertex[i])
            return x->vertex[i] < y->vertex[i] ? -1 : 1;
    return 0;
}

static int compare_sets(const void *a, const void *b)
{
    const VertexSet *x = a, *y = b;
    const int order = compare_vertices(x, y);
    return order != 0 ? order : (x->tet > y->tet) - (x->tet < y->tet);
}

static VertexSet vertex_set(const OstMeshChunk *chunk, OstLocal tet)
{
    const OstGlobal *nodes = chunk->tet_nodes + (size_t)tet * (size_t)chunk->nodes_per_tet;
    VertexSet set = {.tet = tet};
    for (int i = 0; i < 4; i++) {
        int place = i;
        for (; place > 0 && set.vertex[place - 1] > nodes[i]; place--)
            set.vertex[place] = set.vertex[place - 1];
        set.vertex[place] = (OstLocal)nodes[i];
    }
    return set;
}

/* Tets of each region. */
static void count_tets(const OstMeshChunk *chunk, OstLocal *count)
{
    memset(count, 0, (size_t)chunk->regions.count * sizeof *count);
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        if (chunk->tet_region[t] >= 0)
            count[chunk->tet_region[t]]++;
}

/* Keeps the first of tets with the same vertices, in the smallest of their regions; the others get region -1. */
static OstStatus join_run(OstMeshChunk *chunk, const char *path, const OstLocal *count, const VertexSet *first,
                          OstLocal length)
{
    int32_t *region = chunk->tet_region, smallest = region[first->tet];
    for (OstLocal i = 1; i < length; i++) {
        const OstLocal before = first[i - 1].tet, tet = first[i].tet;
        if (region[tet] == region[before] && chunk->tet_label[tet] != chunk->tet_label[before])
            return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                             "%s: %s %" PRId64 " and %" PRId64 " of region '%s' have the same vertices; remove one",
                             path, chunk->of_cells ? "tets of the elements" : "tets",
                             ost_cell_label(chunk->of_cells, chunk->tet_label[before]),
                             ost_cell_label(chunk->of_cells, chunk->tet_label[tet]), chunk->regions.name[region[tet]]);
        if (count[region[tet]] < count[smallest])
            smallest = region[tet];
    }
    for (OstLocal i = 1; i < length; i++)
        region[first[i].tet] = -1;
    region[first->tet] = smallest;
    return OST_SUCCESS;
}

static void remove_joined(OstMeshChunk *chunk)
{
    const size_t width = (size_t)chunk->nodes_per_tet;
    OstLocal kept = 0;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        if (chunk->tet_region[t] < 0)
            continue;
        memmove(chunk->tet_nodes + (size_t)kept * width, chunk->tet_nodes + (size_t)t * width,
                width * sizeof *chunk->tet_nodes);
        chunk->tet_label[kept] = chunk->tet_label[t];
        chunk->tet_region[kept++] = chunk->tet_region[t];
    }
    chunk->global_tets = chunk->tet_count = kept;
}

/* Removes regions without tets; `number` is used to renumber the others. */
static void remove_empty_regions(OstMeshChunk *chunk, const char *path, OstLocal *number)
{
    OstNames *regions = &chunk->regions;
    int kept = 0;
    count_tets(chunk, number);
    for (int r = 0; r < regions->count; r++) {
        if (number[r] == 0) {
            ost_warn(chunk->ctx, "%s: region '%s' has no tets that are in no smaller region, and is left out", path,
                     regions->name[r]);
            OST_FREE(regions->name[r]);
            continue;
        }
        regions->name[kept] = regions->name[r];
        number[r] = kept++;
    }
    regions->count = kept;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        chunk->tet_region[t] = number[chunk->tet_region[t]];
}

static OstStatus join_sets(OstMeshChunk *chunk, const char *path, const VertexSet *set, OstLocal *count)
{
    const OstLocal before = chunk->tet_count;
    OstLocal shared = 0, length = 1;
    count_tets(chunk, count);
    for (OstLocal t = 0; t < before; t += length) {
        for (length = 1; t + length < before && compare_vertices(&set[t], &set[t + length]) == 0;)
            length++;
        if (length == 1)
            continue;
        OST_TRY(join_run(chunk, path, count, &set[t], length));
        shared++;
    }
    if (shared == 0)
        return OST_SUCCESS;
    remove_joined(chunk);
    ost_warn(chunk->ctx, "%s: tets in several physical volumes: %d; each is put into the smallest of these only", path,
             shared);
    remove_empty_regions(chunk, path, count);
    return OST_SUCCESS;
}

OstStatus ost_tets_join_same(OstMeshChunk *chunk, const char *path)
{
    VertexSet *set = NULL;
    OstLocal *count = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(chunk->ctx, &set, chunk->tet_count));
    OST_TRY_DONE(OST_NEW(chunk->ctx, &count, chunk->regions.count));
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        set[t] = vertex_set(chunk, t);
    qsort(set, (size_t)chunk->tet_count, sizeof *set, compare_sets);
    OST_TRY_DONE(join_sets(chunk, path, set, count));
done:
    OST_FREE(set, count);
    return status;
}

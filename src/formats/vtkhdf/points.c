/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/points.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "formats/vtkhdf/match.h"

#include <string.h>

const char *const ost_point_labels[] = {"vertex",        "GlobalNodeId", "GlobalNodeIds", "GlobalPointIds",
                                        "GlobalPointId", "GlobalIds",    "vtkGlobalIds",  NULL};

/* What must be equal for two points to match. */
typedef enum { PLACE = 1, PIECE = 2, PLACE_AND_LABEL = 4 } Criterion;

/* Work arrays of a merge, one entry a point of this rank's share. */
typedef struct Merge {
    const OstHdf5 *h5;
    OstFilePoints *points;
    OstKey *key;
    OstGlobal *self;           /* each point's number in the file */
    OstGlobal *matched;        /* the first point in the file that matches it */
    OstGlobal *representative; /* the first point in the file that is the same node */
} Merge;

void ost_file_points_free(OstFilePoints *points)
{
    OST_FREE(points->piece_start, points->coordinates, points->label, points->node);
}

static OstGlobal piece_of(const OstFilePoints *points, OstGlobal point)
{
    OstGlobal low = 0, high = points->piece_count;
    while (high - low > 1) {
        const OstGlobal middle = low + (high - low) / 2;
        if (points->piece_start[middle] <= point)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Keys of the points: label, or place if there are no labels; and for some criteria the piece, or the place, as well.
 */
static void fill_keys(Merge *merge, Criterion criterion)
{
    const OstFilePoints *points = merge->points;
    for (OstLocal i = 0; i < points->count; i++) {
        OstKey *key = &merge->key[i];
        *key = (OstKey){{0}};
        if (!points->label || criterion == PLACE_AND_LABEL) {
            double place[3];
            for (int k = 0; k < 3; k++)
                place[k] = points->coordinates[3 * (size_t)i + (size_t)k] + 0.0; /* -0 becomes 0 */
            memcpy(key->word, place, sizeof place);
            if (points->label)
                key->word[3] = points->label[i];
        } else {
            key->word[0] = points->label[i];
        }
        if (criterion == PIECE)
            key->word[3] = piece_of(points, merge->self[i]);
    }
}

static OstStatus match(Merge *merge, Criterion criterion, OstGlobal *answer)
{
    const OstLocal n = merge->points->count;
    fill_keys(merge, criterion);
    return ost_match_keys(merge->h5->ctx, n, merge->key, merge->self, n, merge->key, answer);
}

static OstStatus raise_duplicate(const Merge *merge, OstLocal i)
{
    const OstFilePoints *points = merge->points;
    const long long a = merge->matched[i], b = merge->self[i];
    const long long piece = piece_of(points, b);
    if (points->label)
        return OST_RAISE(merge->h5->ctx, OST_INVALID_INPUT,
                         "%s: points %lld and %lld of piece %lld both have the label %lld in the array \"%s\"; "
                         "labels must differ within a piece",
                         merge->h5->path, a, b, piece, (long long)points->label[i], points->labelled);
    return OST_RAISE(merge->h5->ctx, OST_INVALID_INPUT,
                     "%s: points %lld and %lld of piece %lld are at the same place, so it is unknown which of them "
                     "other pieces share; give the points labels (an integer point array \"vertex\" or "
                     "\"GlobalNodeId\")",
                     merge->h5->path, a, b, piece);
}

/* Two points of one piece must not match. */
static OstStatus refuse_duplicates(Merge *merge)
{
    OstStatus status = OST_SUCCESS;
    OST_TRY(match(merge, PIECE, merge->matched));
    for (OstLocal i = 0; i < merge->points->count && status == OST_SUCCESS; i++)
        if (merge->matched[i] != merge->self[i])
            status = raise_duplicate(merge, i);
    return ost_agree(merge->h5->ctx, status);
}

/* Points of one label must be at one place. */
static OstStatus check_places(Merge *merge)
{
    OstStatus status = OST_SUCCESS;
    OST_TRY(match(merge, PLACE_AND_LABEL, merge->matched));
    for (OstLocal i = 0; i < merge->points->count && status == OST_SUCCESS; i++)
        if (merge->matched[i] != merge->representative[i])
            status = OST_RAISE(merge->h5->ctx, OST_INVALID_INPUT,
                               "%s: points %lld and %lld are both vertex %lld but lie at different places; the labels "
                               "in the array \"%s\" must say which points are one",
                               merge->h5->path, (long long)merge->representative[i], (long long)merge->self[i],
                               (long long)merge->points->label[i], merge->points->labelled);
    return ost_agree(merge->h5->ctx, status);
}

static OstStatus find_representatives(Merge *merge)
{
    const int many = merge->points->piece_count > 1;
    memcpy(merge->representative, merge->self, (size_t)merge->points->count * sizeof *merge->self);
    if (many || merge->points->label)
        OST_TRY(refuse_duplicates(merge));
    if (!many)
        return OST_SUCCESS;
    OST_TRY(match(merge, PLACE, merge->representative));
    return merge->points->label ? check_places(merge) : OST_SUCCESS;
}

/* The chunk's nodes are the representatives in this rank's share. */
static OstStatus take_nodes(const Merge *merge, OstMeshChunk *chunk)
{
    const OstFilePoints *points = merge->points;
    OstLocal n = 0;
    for (OstLocal i = 0; i < points->count; i++)
        n += merge->representative[i] == merge->self[i];
    OST_TRY(OST_NEW(chunk->ctx, &chunk->coordinates, 3 * (size_t)n));
    if (points->label)
        OST_TRY(OST_NEW(chunk->ctx, &chunk->node_label, n));
    for (OstLocal i = 0; i < points->count; i++) {
        if (merge->representative[i] != merge->self[i])
            continue;
        const size_t node = (size_t)chunk->node_count++;
        memcpy(chunk->coordinates + 3 * node, points->coordinates + 3 * (size_t)i, 3 * sizeof(double));
        if (points->label)
            chunk->node_label[node] = points->label[i];
    }
    return OST_SUCCESS;
}

/* Numbers the representatives; the other points ask for their representative's number. */
static OstStatus number_points(Merge *merge, const OstMeshChunk *chunk)
{
    OstFilePoints *points = merge->points;
    OstLocal pool = 0;
    for (OstLocal i = 0; i < points->count; i++)
        if (merge->representative[i] == merge->self[i]) {
            points->node[i] = chunk->first_node + pool;
            merge->matched[pool] = points->node[i];
            merge->key[pool++] = (OstKey){{merge->self[i]}};
        }
    if (points->piece_count == 1)
        return OST_SUCCESS;
    OstKey *query = NULL;
    OstStatus status = ost_agree(merge->h5->ctx, OST_NEW(merge->h5->ctx, &query, points->count));
    for (OstLocal i = 0; status == OST_SUCCESS && i < points->count; i++)
        query[i].word[0] = merge->representative[i];
    OST_THEN(ost_match_keys(merge->h5->ctx, pool, merge->key, merge->matched, points->count, query, points->node));
    OST_FREE(query);
    return status;
}

static OstStatus allocate_merge(OstContext *ctx, Merge *merge)
{
    const OstLocal n = merge->points->count;
    OST_TRY(OST_NEW(ctx, &merge->key, n));
    OST_TRY(OST_NEW(ctx, &merge->self, n));
    OST_TRY(OST_NEW(ctx, &merge->matched, n));
    OST_TRY(OST_NEW(ctx, &merge->representative, n));
    OST_TRY(OST_NEW(ctx, &merge->points->node, n));
    for (OstLocal i = 0; i < n; i++)
        merge->self[i] = merge->points->first + i;
    return OST_SUCCESS;
}

OstStatus ost_file_points_merge(const OstHdf5 *h5, OstFilePoints *points, OstMeshChunk *chunk)
{
    OstContext *ctx = h5->ctx;
    Merge merge = {.h5 = h5, .points = points};
    OstStatus status = OST_SUCCESS;
    OstRows nodes;
    OST_TRY_DONE(ost_agree(ctx, allocate_merge(ctx, &merge)));
    OST_TRY_DONE(find_representatives(&merge));
    if (points->label && points->labelled != ost_point_labels[0])
        OST_FREE(points->label);
    OST_TRY_DONE(ost_agree(ctx, take_nodes(&merge, chunk)));
    OST_TRY_DONE(ost_rows_create(ctx, chunk->node_count, &nodes));
    chunk->first_node = nodes.first;
    chunk->global_nodes = nodes.total;
    OST_TRY_DONE(number_points(&merge, chunk));
done:
    OST_FREE(merge.key, merge.self, merge.matched, merge.representative);
    return status;
}

/* --- from points to nodes --- */

static int is_mine(const OstFilePoints *points, OstGlobal point)
{
    return point >= points->first && point < points->first + points->count;
}

OstStatus ost_file_points_to_nodes(OstContext *ctx, const OstFilePoints *points, size_t count, OstGlobal *point)
{
    OstNumberSet others = {0};
    OstGlobal *node = NULL;
    OstKey *pool = NULL, *query = NULL;
    OstStatus status = OST_SUCCESS;
    for (size_t i = 0; i < count && status == OST_SUCCESS; i++)
        if (!is_mine(points, point[i]))
            status = ost_number_set_add(ctx, &others, point[i]);
    ost_number_set_close(&others);
    OST_THEN(OST_NEW(ctx, &node, others.count));
    OST_THEN(OST_NEW(ctx, &pool, ost_size(ctx) > 1 ? points->count : 0));
    OST_THEN(OST_NEW(ctx, &query, others.count));
    OST_TRY_DONE(ost_agree(ctx, status));
    if (ost_size(ctx) > 1) {
        for (OstLocal i = 0; i < points->count; i++)
            pool[i].word[0] = points->first + i;
        for (OstLocal i = 0; i < others.count; i++)
            query[i].word[0] = others.number[i];
        OST_TRY_DONE(ost_match_keys(ctx, points->count, pool, points->node, others.count, query, node));
    }
    for (size_t i = 0; i < count; i++) {
        if (is_mine(points, point[i]))
            point[i] = points->node[point[i] - points->first];
        else
            point[i] = node[ost_numbers_find(others.count, others.number, point[i])];
    }
done:
    ost_number_set_clear(&others);
    OST_FREE(node, pool, query);
    return status;
}

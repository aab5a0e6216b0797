/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/match.h"

#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/parallel/route.h"
#include "core/scatter.h"

/* The rank where equal keys meet. */
static int rank_of(OstContext *ctx, const OstKey *key)
{
    uint64_t hash = 0;
    for (int w = 0; w < OST_KEY_WORDS; w++)
        hash = ost_scatter(hash ^ (uint64_t)key->word[w]);
    return (int)((hash >> 32) % (uint64_t)ost_size(ctx));
}

static OstStatus create_route(OstContext *ctx, OstLocal count, const OstKey *key, OstRoute **route)
{
    int *to = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &to, count)));
    for (OstLocal i = 0; i < count; i++)
        to[i] = rank_of(ctx, &key[i]);
    const OstStatus status = ost_route_create(ctx, count, 1, to, route);
    OST_FREE(to);
    return status;
}

/* Puts the smallest value of equal keys at their place in the index. */
static OstStatus fill_index(OstLocal count, const OstKey *key, OstGlobal *value, OstIndex *index)
{
    OstLocal place = 0;
    for (OstLocal i = 0; i < count; i++) {
        const OstLocal known = index->count;
        OST_TRY(ost_index_place(index, key[i].word, &place));
        if (place == known || value[i] < value[place])
            value[place] = value[i];
    }
    return OST_SUCCESS;
}

static OstStatus look_up(const OstIndex *index, const OstGlobal *value, OstLocal count, const OstKey *key,
                         OstGlobal **answer)
{
    OST_TRY(OST_NEW(index->ctx, answer, count));
    for (OstLocal i = 0; i < count; i++) {
        const OstLocal place = ost_index_find(index, key[i].word);
        (*answer)[i] = place < 0 ? -1 : value[place];
    }
    return OST_SUCCESS;
}

OstStatus ost_match_keys(OstContext *ctx, OstLocal pool_count, const OstKey *pool_key, const OstGlobal *pool_value,
                         OstLocal query_count, const OstKey *query_key, OstGlobal *answer)
{
    OstRoute *pool = NULL, *query = NULL;
    OstIndex *index = NULL;
    OstKey *keys = NULL, *asked = NULL;
    OstGlobal *values = NULL, *found = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(create_route(ctx, pool_count, pool_key, &pool));
    OST_TRY_DONE(ost_route_carry(pool, sizeof *pool_key, pool_key, (void **)&keys));
    OST_TRY_DONE(ost_route_carry(pool, sizeof *pool_value, pool_value, (void **)&values));
    status = ost_index_create(ctx, OST_KEY_WORDS, &index);
    OST_THEN(fill_index(pool->receives, keys, values, index));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_FREE(keys);
    OST_TRY_DONE(create_route(ctx, query_count, query_key, &query));
    OST_TRY_DONE(ost_route_carry(query, sizeof *query_key, query_key, (void **)&asked));
    OST_TRY_DONE(ost_agree(ctx, look_up(index, values, query->receives, asked, &found)));
    OST_TRY_DONE(ost_route_answer(query, sizeof *found, found, answer));
done:
    ost_route_destroy(&pool);
    ost_route_destroy(&query);
    ost_index_destroy(&index);
    OST_FREE(keys, values, asked, found);
    return status;
}

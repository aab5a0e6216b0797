/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf_match.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/scatter.h"

#include <limits.h>
#include <string.h>

/* Which item goes where: items are sent sorted by rank. */
typedef struct Route {
    int *send_count, *send_start, *receive_count, *receive_start; /* by rank */
    int *place;                                                   /* of each item among those sent */
    OstLocal count, received;
} Route;

/* An open hash table of the values put in on this rank. */
typedef struct Table {
    uint64_t mask;
    const OstKey *key;
    OstGlobal *value;
    OstLocal *slot; /* item + 1, or 0 */
} Table;

static uint64_t hash_key(const OstKey *key)
{
    uint64_t hash = 0;
    for (int i = 0; i < 4; i++)
        hash = ost_scatter(hash ^ key->word[i]);
    return hash;
}

/* The rank comes from the upper half of the hash, the slot in the table from the lower. */
static int rank_of(OstContext *ctx, const OstKey *key)
{
    return (int)((hash_key(key) >> 32) % (uint64_t)ost_size(ctx));
}

static void destroy_route(Route *route)
{
    OST_FREE(route->send_count);
    OST_FREE(route->send_start);
    OST_FREE(route->receive_count);
    OST_FREE(route->receive_start);
    OST_FREE(route->place);
}

static OstStatus allocate_route(OstContext *ctx, Route *route)
{
    const int size = ost_size(ctx);
    OST_TRY(OST_NEW(ctx, &route->send_count, size));
    OST_TRY(OST_NEW(ctx, &route->send_start, size + 1));
    OST_TRY(OST_NEW(ctx, &route->receive_count, size));
    OST_TRY(OST_NEW(ctx, &route->receive_start, size + 1));
    return OST_NEW(ctx, &route->place, route->count);
}

static OstStatus check_received(OstContext *ctx, OstGlobal received)
{
    if (received <= INT_MAX)
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                     "%lld points meet on rank %d, but MPI counts to 2^31 - 1; read the file with more ranks",
                     (long long)received, ost_rank(ctx));
}

static OstStatus create_route(OstContext *ctx, OstLocal count, const OstKey *key, Route *route)
{
    const int size = ost_size(ctx);
    *route = (Route){.count = count};
    OST_TRY(ost_agree(ctx, allocate_route(ctx, route)));
    for (OstLocal i = 0; i < count; i++)
        route->send_count[rank_of(ctx, &key[i])]++;
    for (int r = 0; r < size; r++)
        route->send_start[r + 1] = route->send_start[r] + route->send_count[r];
    for (OstLocal i = 0; i < count; i++)
        route->place[i] = route->send_start[rank_of(ctx, &key[i])]++;
    for (int r = 0; r < size; r++)
        route->send_start[r] -= route->send_count[r];
    OST_TRY(OST_MPI(ctx, MPI_Alltoall(route->send_count, 1, MPI_INT, route->receive_count, 1, MPI_INT, ost_comm(ctx))));
    OstGlobal received = 0;
    for (int r = 0; r < size; r++)
        received += route->receive_count[r];
    OST_TRY(ost_agree(ctx, check_received(ctx, received)));
    for (int r = 0; r < size; r++)
        route->receive_start[r + 1] = route->receive_start[r] + route->receive_count[r];
    route->received = (OstLocal)received;
    return OST_SUCCESS;
}

/* Sends items of `size` bytes along the route; `arrived` is made here. */
static OstStatus send_items(OstContext *ctx, const Route *route, size_t size, const void *items, void **arrived)
{
    char *sorted = NULL;
    MPI_Datatype type = MPI_DATATYPE_NULL;
    OstStatus status = ost_allocate(ctx, (size_t)route->count, size, (void **)&sorted);
    if (status == OST_SUCCESS)
        status = ost_allocate(ctx, (size_t)route->received, size, arrived);
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal i = 0; i < route->count; i++)
        memcpy(sorted + (size_t)route->place[i] * size, (const char *)items + (size_t)i * size, size);
    OST_TRY_DONE(OST_MPI(ctx, MPI_Type_contiguous((int)size, MPI_BYTE, &type)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Type_commit(&type)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Alltoallv(sorted, route->send_count, route->send_start, type, *arrived,
                                            route->receive_count, route->receive_start, type, ost_comm(ctx))));
done:
    if (type != MPI_DATATYPE_NULL)
        MPI_Type_free(&type);
    OST_FREE(sorted);
    return status;
}

/* Sends an answer for each item that arrived back to where it came from. */
static OstStatus send_answers(OstContext *ctx, const Route *route, const OstGlobal *answer, OstGlobal *mine)
{
    OstGlobal *sorted = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &sorted, route->count)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Alltoallv(answer, route->receive_count, route->receive_start, MPI_INT64_T, sorted,
                                            route->send_count, route->send_start, MPI_INT64_T, ost_comm(ctx))));
    for (OstLocal i = 0; i < route->count; i++)
        mine[i] = sorted[route->place[i]];
done:
    OST_FREE(sorted);
    return status;
}

/* The slot that holds the key, or the empty one where it would go. */
static OstLocal *find_slot(const Table *table, const OstKey *key)
{
    uint64_t at = hash_key(key) & table->mask;
    while (table->slot[at] && memcmp(&table->key[table->slot[at] - 1], key, sizeof *key) != 0)
        at = (at + 1) & table->mask;
    return &table->slot[at];
}

static OstStatus fill_table(OstContext *ctx, OstLocal count, const OstKey *key, OstGlobal *value, Table *table)
{
    uint64_t size = 16;
    while (size < 2 * (uint64_t)count)
        size *= 2;
    *table = (Table){.mask = size - 1, .key = key, .value = value};
    OST_TRY(OST_NEW(ctx, &table->slot, size));
    for (OstLocal i = 0; i < count; i++) {
        OstLocal *slot = find_slot(table, &key[i]);
        if (*slot == 0)
            *slot = i + 1;
        else if (value[i] < value[*slot - 1])
            value[*slot - 1] = value[i];
    }
    return OST_SUCCESS;
}

static OstStatus look_up(OstContext *ctx, const Table *table, OstLocal count, const OstKey *key, OstGlobal **answer)
{
    OST_TRY(OST_NEW(ctx, answer, count));
    for (OstLocal i = 0; i < count; i++) {
        const OstLocal slot = *find_slot(table, &key[i]);
        (*answer)[i] = slot == 0 ? -1 : table->value[slot - 1];
    }
    return OST_SUCCESS;
}

OstStatus ost_match_keys(OstContext *ctx, OstLocal pool_count, const OstKey *pool_key, const OstGlobal *pool_value,
                         OstLocal query_count, const OstKey *query_key, OstGlobal *answer)
{
    Route pool = {0};
    Route query = {0};
    Table table = {0};
    OstKey *keys = NULL, *asked = NULL;
    OstGlobal *values = NULL, *found = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(create_route(ctx, pool_count, pool_key, &pool));
    OST_TRY_DONE(send_items(ctx, &pool, sizeof *pool_key, pool_key, (void **)&keys));
    OST_TRY_DONE(send_items(ctx, &pool, sizeof *pool_value, pool_value, (void **)&values));
    OST_TRY_DONE(ost_agree(ctx, fill_table(ctx, pool.received, keys, values, &table)));
    OST_TRY_DONE(create_route(ctx, query_count, query_key, &query));
    OST_TRY_DONE(send_items(ctx, &query, sizeof *query_key, query_key, (void **)&asked));
    OST_TRY_DONE(ost_agree(ctx, look_up(ctx, &table, query.received, asked, &found)));
    OST_TRY_DONE(send_answers(ctx, &query, found, answer));
done:
    destroy_route(&pool);
    destroy_route(&query);
    OST_FREE(table.slot);
    OST_FREE(keys);
    OST_FREE(values);
    OST_FREE(asked);
    OST_FREE(found);
    return status;
}

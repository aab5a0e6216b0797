/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/rendezvous.h"

#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/parallel/route.h"
#include "core/scatter.h"

#include <string.h>

/* What the ranks know of the keys that meet here. */
typedef struct Meeting {
    OstContext *ctx;
    size_t size;
    OstIndex *index;
    OstLocal *best; /* of each key: the item that counts */
    OstLocal arrivals;
    OstKey *key; /* of the items that arrived */
    OstGlobal *order;
    char *value;
} Meeting;

static OstStatus route_keys(OstContext *ctx, OstLocal count, const OstKey *key, OstRoute **route)
{
    int *to = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &to, count));
    for (OstLocal i = 0; status == OST_SUCCESS && i < count; i++)
        to[i] = (int)(ost_scatter((uint64_t)key[i].low + ost_scatter((uint64_t)key[i].high)) % (uint64_t)ost_size(ctx));
    OST_THEN(ost_route_create(ctx, count, 1, to, route));
    OST_FREE(to);
    return status;
}

static OstStatus bring(Meeting *meeting, const OstKeyed *known)
{
    OstRoute *route = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(route_keys(meeting->ctx, known->count, known->key, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof(OstKey), known->key, (void **)&meeting->key));
    if (known->order)
        OST_TRY_DONE(ost_route_carry(route, sizeof(OstGlobal), known->order, (void **)&meeting->order));
    OST_TRY_DONE(ost_route_carry(route, meeting->size, known->value, (void **)&meeting->value));
    meeting->arrivals = route->receives;
done:
    ost_route_destroy(&route);
    return status;
}

static OstStatus file(Meeting *meeting)
{
    OST_TRY(ost_index_create(meeting->ctx, 2, &meeting->index));
    OST_TRY(OST_NEW(meeting->ctx, &meeting->best, meeting->arrivals));
    for (OstLocal i = 0; i < meeting->arrivals; i++) {
        const OstLocal known = meeting->index->count;
        OstLocal place = 0;
        OST_TRY(ost_index_place(meeting->index, &meeting->key[i].low, &place));
        if (place == known || (meeting->order && meeting->order[i] < meeting->order[meeting->best[place]]))
            meeting->best[place] = i;
    }
    return OST_SUCCESS;
}

static OstStatus look_up(const Meeting *meeting, const char *what, OstLocal count, const OstKey *key, char *answer)
{
    for (OstLocal i = 0; i < count; i++) {
        const OstLocal place = ost_index_find(meeting->index, &key[i].low);
        if (place < 0)
            return OST_RAISE(meeting->ctx, OST_INVALID_INPUT, "no rank knows the %s (%lld, %lld) that one asks for",
                             what, (long long)key[i].low, (long long)key[i].high);
        memcpy(answer + (size_t)i * meeting->size, meeting->value + (size_t)meeting->best[place] * meeting->size,
               meeting->size);
    }
    return OST_SUCCESS;
}

static OstStatus ask(const Meeting *meeting, const char *what, OstLocal count, const OstKey *key, void *value)
{
    OstContext *ctx = meeting->ctx;
    OstRoute *route = NULL;
    OstKey *asked = NULL;
    char *answer = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(route_keys(ctx, count, key, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *asked, key, (void **)&asked));
    status = ost_allocate(ctx, (size_t)route->receives, meeting->size, (void **)&answer);
    OST_THEN(look_up(meeting, what, route->receives, asked, answer));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_route_answer(route, meeting->size, answer, value));
done:
    ost_route_destroy(&route);
    OST_FREE(asked, answer);
    return status;
}

OstStatus ost_rendezvous(OstContext *ctx, const char *what, size_t size, const OstKeyed *known, OstLocal count,
                         const OstKey *key, void *value)
{
    Meeting meeting = {.ctx = ctx, .size = size};
    OstStatus status = bring(&meeting, known);
    OST_THEN(ost_agree(ctx, file(&meeting)));
    OST_THEN(ask(&meeting, what, count, key, value));
    ost_index_destroy(&meeting.index);
    OST_FREE(meeting.best, meeting.key, meeting.order, meeting.value);
    return status;
}

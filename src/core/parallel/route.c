/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/route.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <string.h>

void ost_route_destroy(OstRoute **route)
{
    if (!*route)
        return;
    OST_FREE((*route)->item, (*route)->send_count, (*route)->send_start, (*route)->receive_count,
             (*route)->receive_start);
    OST_FREE(*route);
}

/* Is to[k] a rank that is not among to[0 .. k - 1]? */
static int is_new(const int *to, int k)
{
    if (to[k] < 0)
        return 0;
    for (int j = 0; j < k; j++)
        if (to[j] == to[k])
            return 0;
    return 1;
}

/* Prefix sums of the counts, as int for MPI. */
static OstStatus sum_up(OstContext *ctx, const int *count, int *start, OstLocal *total)
{
    OstGlobal sum = 0;
    for (int r = 0; r < ost_size(ctx); r++) {
        start[r] = (int)sum;
        sum += count[r];
        if (sum > INT_MAX)
            return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                             "a rank sends or receives more than MPI's %d items at once; use more ranks", INT_MAX);
    }
    *total = (OstLocal)sum;
    return OST_SUCCESS;
}

static OstStatus sort_items(OstRoute *route, OstLocal count, int width, const int *to)
{
    OstContext *ctx = route->ctx;
    OST_TRY(OST_NEW(ctx, &route->send_count, ost_size(ctx)));
    OST_TRY(OST_NEW(ctx, &route->send_start, ost_size(ctx)));
    OST_TRY(OST_NEW(ctx, &route->receive_count, ost_size(ctx)));
    OST_TRY(OST_NEW(ctx, &route->receive_start, ost_size(ctx)));
    for (OstLocal i = 0; i < count; i++)
        for (int k = 0; k < width; k++)
            if (is_new(to + (size_t)i * (size_t)width, k))
                route->send_count[to[(size_t)i * (size_t)width + (size_t)k]]++;
    OST_TRY(sum_up(ctx, route->send_count, route->send_start, &route->sends));
    OST_TRY(OST_NEW(ctx, &route->item, route->sends));
    int *next = route->receive_start; /* not in use yet */
    memcpy(next, route->send_start, (size_t)ost_size(ctx) * sizeof *next);
    for (OstLocal i = 0; i < count; i++)
        for (int k = 0; k < width; k++)
            if (is_new(to + (size_t)i * (size_t)width, k))
                route->item[next[to[(size_t)i * (size_t)width + (size_t)k]]++] = i;
    return OST_SUCCESS;
}

OstStatus ost_route_create(OstContext *ctx, OstLocal count, int width, const int *to, OstRoute **route)
{
    *route = NULL;
    OstRoute *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        status = sort_items(made, count, width, to);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    ost_ledger_gathered(ctx, (double)ost_size(ctx) * sizeof *made->send_count);
    OST_TRY_DONE(
        OST_MPI(ctx, MPI_Alltoall(made->send_count, 1, MPI_INT, made->receive_count, 1, MPI_INT, ost_comm(ctx))));
    OST_TRY_DONE(ost_agree(ctx, sum_up(ctx, made->receive_count, made->receive_start, &made->receives)));
done:
    if (status != OST_SUCCESS)
        ost_route_destroy(&made);
    *route = made;
    return status;
}

/* From the sending to the receiving ranks, or back. */
static OstStatus exchange(const OstRoute *route, int back, size_t size, const void *outgoing, void *arrived)
{
    OstContext *ctx = route->ctx;
    MPI_Datatype item;
    OST_TRY(OST_MPI(ctx, MPI_Type_contiguous((int)size, MPI_BYTE, &item)));
    OstStatus status = OST_MPI(ctx, MPI_Type_commit(&item));
    if (status == OST_SUCCESS && !back)
        status = OST_MPI(ctx, MPI_Alltoallv(outgoing, route->send_count, route->send_start, item, arrived,
                                            route->receive_count, route->receive_start, item, ost_comm(ctx)));
    else if (status == OST_SUCCESS)
        status = OST_MPI(ctx, MPI_Alltoallv(outgoing, route->receive_count, route->receive_start, item, arrived,
                                            route->send_count, route->send_start, item, ost_comm(ctx)));
    MPI_Type_free(&item);
    return status;
}

OstStatus ost_route_carry(const OstRoute *route, size_t size, const void *values, void **arrived)
{
    OstContext *ctx = route->ctx;
    char *outgoing = NULL;
    *arrived = NULL;
    OstStatus status = ost_allocate(ctx, (size_t)route->sends, size, (void **)&outgoing);
    OST_THEN(ost_allocate(ctx, (size_t)route->receives, size, arrived));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal s = 0; s < route->sends; s++)
        memcpy(outgoing + (size_t)s * size, (const char *)values + (size_t)route->item[s] * size, size);
    OST_TRY_DONE(ost_agree(ctx, exchange(route, 0, size, outgoing, *arrived)));
done:
    OST_FREE(outgoing);
    if (status != OST_SUCCESS)
        OST_FREE(*arrived);
    return status;
}

OstStatus ost_route_answer(const OstRoute *route, size_t size, const void *answers, void *mine)
{
    OstContext *ctx = route->ctx;
    char *arrived = NULL;
    OstStatus status = ost_agree(ctx, ost_allocate(ctx, (size_t)route->sends, size, (void **)&arrived));
    OST_THEN(ost_agree(ctx, exchange(route, 1, size, answers, arrived)));
    for (OstLocal s = 0; status == OST_SUCCESS && s < route->sends; s++)
        memcpy((char *)mine + (size_t)route->item[s] * size, arrived + (size_t)s * size, size);
    OST_FREE(arrived);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/gather.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>

OstStatus ost_gather(OstContext *ctx, size_t size, const void *items, OstLocal count, void **all, OstLocal *total)
{
    return ost_gather_items(ctx, size, items, count, "more than 2^31 - 1 items to gather; gather fewer", all, total);
}

OstStatus ost_gather_items(OstContext *ctx, size_t size, const void *items, OstLocal count, const char *too_many,
                           void **all, OstLocal *total)
{
    const int ranks = ost_size(ctx);
    int *counts = NULL; /* of each rank; behind them, where each rank's items start */
    MPI_Datatype item = MPI_DATATYPE_NULL;
    OstGlobal sum = 0;
    *all = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &counts, 2 * (size_t)ranks));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(OST_MPI(ctx, MPI_Allgather(&count, 1, MPI_INT32_T, counts, 1, MPI_INT, ost_comm(ctx))));
    for (int r = 0; r < ranks && sum <= INT32_MAX; r++) {
        counts[ranks + r] = (int)sum;
        sum += counts[r];
    }
    if (sum > INT32_MAX)
        OST_TRY_DONE(OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%s", too_many));
    OST_TRY_DONE(ost_agree(ctx, ost_allocate(ctx, (size_t)sum, size, all)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Type_contiguous((int)size, MPI_BYTE, &item)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Type_commit(&item)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Allgatherv(items, count, item, *all, counts, counts + ranks, item, ost_comm(ctx))));
    *total = (OstLocal)sum;
done:
    if (item != MPI_DATATYPE_NULL)
        MPI_Type_free(&item);
    if (status != OST_SUCCESS)
        OST_FREE(*all);
    OST_FREE(counts);
    return status;
}

OstStatus ost_broadcast(OstContext *ctx, size_t bytes, void *data)
{
    for (size_t done = 0, piece; done < bytes; done += piece) {
        piece = bytes - done < INT_MAX ? bytes - done : INT_MAX;
        OST_TRY(OST_MPI(ctx, MPI_Bcast((char *)data + done, (int)piece, MPI_BYTE, 0, ost_comm(ctx))));
    }
    return OST_SUCCESS;
}

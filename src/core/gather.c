/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/gather.h"

#include "core/error.h"
#include "core/memory.h"

/* `counts` has a number for each rank, then where its items start. */
static OstStatus share_counts(OstContext *ctx, OstLocal count, const char *too_many, int *counts, OstLocal *total)
{
    const int mine = count;
    const int size = ost_size(ctx);
    OstGlobal sum = 0;
    OST_TRY(OST_MPI(ctx, MPI_Allgather(&mine, 1, MPI_INT, counts, 1, MPI_INT, ost_comm(ctx))));
    for (int r = 0; r < size && sum <= INT32_MAX; r++) {
        counts[size + r] = (int)sum;
        sum += counts[r];
    }
    if (sum > INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%s", too_many);
    *total = (OstLocal)sum;
    return OST_SUCCESS;
}

OstStatus ost_gather_items(OstContext *ctx, size_t item_bytes, OstLocal count, const void *items, const char *too_many,
                           void **all, OstLocal *total)
{
    const int size = ost_size(ctx);
    int *counts = NULL;
    MPI_Datatype item = MPI_DATATYPE_NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &counts, 2 * (size_t)size)));
    OST_TRY_DONE(share_counts(ctx, count, too_many, counts, total));
    OST_TRY_DONE(ost_agree(ctx, ost_allocate(ctx, (size_t)*total, item_bytes, all)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Type_contiguous((int)item_bytes, MPI_BYTE, &item)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Type_commit(&item)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Allgatherv(items, count, item, *all, counts, counts + size, item, ost_comm(ctx))));
done:
    if (item != MPI_DATATYPE_NULL)
        MPI_Type_free(&item);
    OST_FREE(counts);
    return status;
}

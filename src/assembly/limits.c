/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"
#include "core/error.h"

OstStatus ost_limit_unknowns(OstContext *ctx, OstGlobal global_rows)
{
    if (global_rows <= INT32_MAX / 3)
        return OST_SUCCESS;
    return OST_RAISE(
        ctx, OST_LIMIT_EXCEEDED,
        "%lld vertices are free, which makes %lld unknowns; Epetra and ML number at most 2^31 - 1 over all "
        "ranks: use a coarser mesh",
        (long long)global_rows, 3 * (long long)global_rows);
}

OstStatus ost_limit_nonzeros(OstContext *ctx, OstGlobal blocks)
{
    if (blocks <= INT32_MAX / 9)
        return OST_SUCCESS;
    return OST_RAISE(
        ctx, OST_LIMIT_EXCEEDED,
        "rank %d has %lld nonzeros of the stiffness matrix; ML numbers at most 2^31 - 1 on a rank: use more "
        "ranks",
        ost_rank(ctx), 9 * (long long)blocks);
}

OstStatus ost_limit_incidences(OstContext *ctx, OstGlobal tets, int nodes_per_tet)
{
    if (tets <= INT32_MAX / nodes_per_tet)
        return OST_SUCCESS;
    return OST_RAISE(
        ctx, OST_LIMIT_EXCEEDED,
        "rank %d has %lld tets of %d nodes; at most 2^31 - 1 nodes of tets can be listed on a rank: use more "
        "ranks",
        ost_rank(ctx), (long long)tets, nodes_per_tet);
}

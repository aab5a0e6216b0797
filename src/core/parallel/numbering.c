/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/numbering.h"

#include "core/error.h"
#include "core/parallel/reduce.h"

OstStatus ost_number_from(OstContext *ctx, OstGlobal count, OstGlobal *first, OstGlobal *total)
{
    *first = 0;
    OST_TRY(OST_MPI(ctx, MPI_Exscan(&count, first, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    if (ost_rank(ctx) == 0) /* MPI leaves it undefined there */
        *first = 0;
    *total = count;
    return ost_sum_numbers(ctx, 1, total);
}

OstStatus ost_number_ends(OstContext *ctx, OstGlobal my_end, OstGlobal *end)
{
    ost_ledger_gathered(ctx, (double)ost_size(ctx) * sizeof my_end);
    return OST_MPI(ctx, MPI_Allgather(&my_end, 1, MPI_INT64_T, end, 1, MPI_INT64_T, ost_comm(ctx)));
}

int ost_number_holder(const OstGlobal *end, int ranks, OstGlobal number)
{
    int low = 0;
    int high = ranks - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (number < end[middle])
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

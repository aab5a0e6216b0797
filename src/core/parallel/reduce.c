/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/reduce.h"

#include "core/error.h"

static OstStatus reduce(OstContext *ctx, int count, void *values, MPI_Datatype type, MPI_Op operation)
{
    ost_ledger_reduced(ctx, 1);
    return OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, values, count, type, operation, ost_comm(ctx)));
}

OstStatus ost_sum(OstContext *ctx, int count, double *values)
{
    return reduce(ctx, count, values, MPI_DOUBLE, MPI_SUM);
}

OstStatus ost_max(OstContext *ctx, int count, double *values)
{
    return reduce(ctx, count, values, MPI_DOUBLE, MPI_MAX);
}

OstStatus ost_min(OstContext *ctx, int count, double *values)
{
    return reduce(ctx, count, values, MPI_DOUBLE, MPI_MIN);
}

OstStatus ost_sum_numbers(OstContext *ctx, int count, OstGlobal *numbers)
{
    return reduce(ctx, count, numbers, MPI_INT64_T, MPI_SUM);
}

OstStatus ost_max_numbers(OstContext *ctx, int count, OstGlobal *numbers)
{
    return reduce(ctx, count, numbers, MPI_INT64_T, MPI_MAX);
}

OstStatus ost_min_numbers(OstContext *ctx, int count, OstGlobal *numbers)
{
    return reduce(ctx, count, numbers, MPI_INT64_T, MPI_MIN);
}

OstStatus ost_max_ints(OstContext *ctx, int count, int *numbers)
{
    return reduce(ctx, count, numbers, MPI_INT, MPI_MAX);
}

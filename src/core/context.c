/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/context.h"

#include "core/address_space.h"

#include <stdlib.h>

OstStatus ost_context_create(MPI_Comm comm, OstContext **ctx)
{
    OstContext *made = calloc(1, sizeof *made);
    *ctx = NULL;
    if (!made || !ost_start_blas()) {
        free(made);
        return OST_OUT_OF_MEMORY;
    }
    if (MPI_Comm_dup(comm, &made->comm) != MPI_SUCCESS ||
        MPI_Comm_set_errhandler(made->comm, MPI_ERRORS_RETURN) != MPI_SUCCESS ||
        MPI_Comm_rank(made->comm, &made->rank) != MPI_SUCCESS ||
        MPI_Comm_size(made->comm, &made->size) != MPI_SUCCESS) {
        free(made);
        return OST_LIBRARY_FAILED;
    }
    made->level = OST_LOG_NORMAL;
    ost_ledger_open(made);
    *ctx = made;
    return OST_SUCCESS;
}

OstStatus ost_context_create_by_number(int comm, OstContext **ctx)
{
    return ost_context_create(MPI_Comm_f2c(comm), ctx);
}

/* Did we start MPI? A matter of the process, as MPI is. */
static int started;

OstStatus ost_context_create_on_all(OstContext **ctx)
{
    int runs = 0;
    *ctx = NULL;
    if (MPI_Initialized(&runs) != MPI_SUCCESS || (!runs && MPI_Init(NULL, NULL) != MPI_SUCCESS))
        return OST_LIBRARY_FAILED;
    started |= !runs;
    return ost_context_create(MPI_COMM_WORLD, ctx);
}

void ost_end_mpi(void)
{
    int ended = 0;
    if (started && MPI_Finalized(&ended) == MPI_SUCCESS && !ended)
        MPI_Finalize();
}

void ost_context_destroy(OstContext **ctx)
{
    if (!*ctx)
        return;
    ost_progress(*ctx, "", -1.0);
    MPI_Comm_free(&(*ctx)->comm);
    ost_forget_warnings(*ctx);
    free(*ctx);
    *ctx = NULL;
}

MPI_Comm ost_comm(const OstContext *ctx)
{
    return ctx->comm;
}

int ost_rank(const OstContext *ctx)
{
    return ctx->rank;
}

int ost_size(const OstContext *ctx)
{
    return ctx->size;
}

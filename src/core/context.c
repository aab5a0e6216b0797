/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/context.h"

#include "core/memory.h"

#include <stdlib.h>

extern void dpotrf_(const char *uplo, const int *n, double *a, const int *leading, int *info, size_t length);

/* OpenBLAS takes a buffer of 128 MiB when it is first called, keeps it, and asks for ever where it gets none: it is
 * made to take it at once, while there is room. */
static int start_blas(void)
{
    enum { BUFFER_MIB = 160 };
    const int n = 1;
    int info = 0;
    double one = 1.0;
    if (!ost_address_space_has(BUFFER_MIB))
        return 0;
    dpotrf_("L", &n, &one, &n, &info, 1);
    return info == 0;
}

OstStatus ost_context_create(MPI_Comm comm, OstContext **ctx)
{
    OstContext *made = calloc(1, sizeof *made);
    *ctx = NULL;
    if (!made || !start_blas()) {
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

void ost_context_destroy(OstContext **ctx)
{
    if (!*ctx)
        return;
    ost_progress(*ctx, "", -1.0);
    MPI_Comm_free(&(*ctx)->comm);
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

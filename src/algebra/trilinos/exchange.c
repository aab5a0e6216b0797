/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/exchange.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <ml_include.h>

struct OstExchange {
    OstContext *ctx;
    ML_Comm *comm;
    ML_CommInfoOP *to_ghosts, *to_owners;
    int unknowns;    /* that this rank owns */
    int messages[2]; /* to ghosts, to owners */
    double bytes[2];
};

void ost_exchange_destroy(OstExchange **exchange)
{
    if (!*exchange)
        return;
    if ((*exchange)->to_ghosts)
        ML_CommInfoOP_Destroy(&(*exchange)->to_ghosts);
    if ((*exchange)->to_owners)
        ML_CommInfoOP_Destroy(&(*exchange)->to_owners);
    if ((*exchange)->comm)
        ML_Comm_Destroy(&(*exchange)->comm);
    OST_FREE(*exchange);
}

/* Lists which numbers of x are sent to and received from each neighbour, for both directions. ML copies the lists; its
 * functions cannot fail. */
static void list_numbers(const OstHalo *halo, int width, int *owned, int *ghost, OstExchange *exchange)
{
    for (OstLocal i = 0; i < halo->send_start[halo->neighbour_count]; i++)
        for (int c = 0; c < width; c++)
            owned[width * i + c] = width * halo->send_index[i] + c;
    for (int i = 0; i < width * halo->ghosts; i++)
        ghost[i] = width * halo->owned + i;
    ML_CommInfoOP_Set_neighbors(&exchange->to_ghosts, halo->neighbour_count, halo->neighbour, ML_OVERWRITE, NULL, 0);
    ML_CommInfoOP_Set_neighbors(&exchange->to_owners, halo->neighbour_count, halo->neighbour, ML_ADD, NULL, 0);
    for (int k = 0; k < halo->neighbour_count; k++) {
        int *mine = owned + width * halo->send_start[k], *theirs = ghost + width * halo->receive_start[k];
        const int out = width * (halo->send_start[k + 1] - halo->send_start[k]);
        const int in = width * (halo->receive_start[k + 1] - halo->receive_start[k]);
        ML_CommInfoOP_Set_exch_info(exchange->to_ghosts, halo->neighbour[k], in, theirs, out, mine);
        ML_CommInfoOP_Set_exch_info(exchange->to_owners, halo->neighbour[k], out, mine, in, theirs);
    }
}

static OstStatus check_limit(const OstHalo *halo, int width)
{
    const OstGlobal numbers = (OstGlobal)width * ((OstGlobal)halo->owned + halo->ghosts);
    if (numbers > INT_MAX)
        return OST_RAISE(halo->ctx, OST_LIMIT_EXCEEDED,
                         "%lld unknowns on rank %d are more than ML can number (2^31 - 1); use more ranks",
                         (long long)numbers, ost_rank(halo->ctx));
    return OST_SUCCESS;
}

OstStatus ost_exchange_create(const OstHalo *halo, int width, OstExchange **exchange)
{
    OstContext *ctx = halo->ctx;
    OstExchange *made = NULL;
    int *owned = NULL, *ghost = NULL;
    *exchange = NULL;
    OstStatus status;
    OST_TRY_DONE(check_limit(halo, width));
    OST_TRY_DONE(OST_NEW(ctx, &made, 1));
    OST_TRY_DONE(OST_NEW(ctx, &owned, width * halo->send_start[halo->neighbour_count]));
    OST_TRY_DONE(OST_NEW(ctx, &ghost, width * halo->ghosts));
    made->ctx = ctx;
    made->unknowns = width * halo->owned;
    made->messages[0] = ost_halo_messages(halo, halo->send_start);
    made->messages[1] = ost_halo_messages(halo, halo->receive_start);
    made->bytes[0] = (double)width * sizeof(double) * halo->send_start[halo->neighbour_count];
    made->bytes[1] = (double)width * sizeof(double) * halo->ghosts;
    ML_Comm_Create(&made->comm);
    ML_Comm_Set_UsrComm(made->comm, ost_comm(ctx));
    ML_Comm_Set_Mypid(made->comm, ost_rank(ctx));
    ML_Comm_Set_Nprocs(made->comm, ost_size(ctx));
    list_numbers(halo, width, owned, ghost, made);
done:
    OST_FREE(owned, ghost);
    if (status != OST_SUCCESS)
        ost_exchange_destroy(&made);
    *exchange = made;
    return ost_agree(ctx, status);
}

int ost_exchange_any(const OstExchange *exchange)
{
    return exchange->messages[0] + exchange->messages[1] > 0;
}

static void book(const OstExchange *exchange, int back)
{
    if (ost_exchange_any(exchange))
        ost_ledger_sent(exchange->ctx, exchange->messages[back], exchange->bytes[back]);
}

void ost_exchange_import(const OstExchange *exchange, double *x)
{
    book(exchange, 0);
    ML_exchange_bdry(x, exchange->to_ghosts, exchange->unknowns, exchange->comm, ML_OVERWRITE, NULL);
}

void ost_exchange_add_to_owners(const OstExchange *exchange, double *x)
{
    book(exchange, 1);
    ML_exchange_bdry(x, exchange->to_owners, exchange->unknowns, exchange->comm, ML_ADD, NULL);
}

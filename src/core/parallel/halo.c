/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/halo.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"

#include <limits.h>
#include <math.h>
#include <string.h>

enum { HALO_TAG = 7171 };

/* Allocates the buffer, and checks that the length of every message fits MPI's int. */
static OstStatus reserve_buffer(OstHalo *halo)
{
    const int n = halo->neighbour_count;
    for (int k = 0; k < n; k++) {
        const OstLocal sends = halo->send_start[k + 1] - halo->send_start[k];
        const OstLocal receives = halo->receive_start[k + 1] - halo->receive_start[k];
        const OstLocal most = sends > receives ? sends : receives;
        if (most > INT_MAX / OST_LARGEST_ENTRY)
            return OST_RAISE(halo->ctx, OST_LIMIT_EXCEEDED,
                             "%d entries shared with rank %d make messages beyond MPI's 2^31 - 1 bytes; use more ranks",
                             most, halo->neighbour[k]);
    }
    return ost_allocate(halo->ctx, (size_t)halo->send_start[n], OST_LARGEST_ENTRY, &halo->buffer);
}

void ost_halo_destroy(OstHalo **halo)
{
    if (!*halo)
        return;
    OST_FREE((*halo)->neighbour, (*halo)->send_start, (*halo)->send_index, (*halo)->receive_start, (*halo)->buffer,
             (*halo)->request);
    OST_FREE(*halo);
}

static OstStatus check_ghosts(OstContext *ctx, const OstGlobal *end, OstLocal ghosts, const OstGlobal *ghost_number,
                              int *receive_count)
{
    int last_owner = -1;
    for (OstLocal g = 0; g < ghosts; g++) {
        const OstGlobal number = ghost_number[g];
        if (number < 0 || number >= end[ost_size(ctx) - 1])
            return OST_RAISE(ctx, OST_INVALID_INPUT, "halo: no rank owns entry %lld", (long long)number);
        const int owner = ost_number_holder(end, ost_size(ctx), number);
        if (owner == ost_rank(ctx) || owner < last_owner)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "halo: ghost %d (entry %lld) is not grouped by owner", g,
                             (long long)number);
        last_owner = owner;
        receive_count[owner]++;
    }
    return OST_SUCCESS;
}

static OstStatus make_lists(OstHalo *halo, const int *send_count, const int *receive_count)
{
    OstContext *ctx = halo->ctx;
    const int size = ost_size(ctx);
    int n = 0;
    for (int r = 0; r < size; r++)
        n += send_count[r] > 0 || receive_count[r] > 0;
    halo->neighbour_count = n;
    OST_TRY(OST_NEW(ctx, &halo->neighbour, n));
    OST_TRY(OST_NEW(ctx, &halo->send_start, n + 1));
    OST_TRY(OST_NEW(ctx, &halo->receive_start, n + 1));
    OST_TRY(OST_NEW(ctx, &halo->request, 2 * n));
    for (int r = 0, k = 0; r < size; r++) {
        if (send_count[r] == 0 && receive_count[r] == 0)
            continue;
        halo->neighbour[k] = r;
        halo->send_start[k + 1] = halo->send_start[k] + send_count[r];
        halo->receive_start[k + 1] = halo->receive_start[k] + receive_count[r];
        k++;
    }
    return OST_NEW(ctx, &halo->send_index, halo->send_start[n]);
}

/* Tells each owner which of its entries are ghosts here. */
static OstStatus exchange_requests(OstHalo *halo, OstGlobal first_number, const OstGlobal *ghost_number)
{
    OstContext *ctx = halo->ctx;
    OstGlobal *asked = NULL;
    const OstLocal sends = halo->send_start[halo->neighbour_count];
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &asked, sends)));
    OstStatus status = OST_SUCCESS;
    int requests = 0;
    for (int k = 0; k < halo->neighbour_count; k++) {
        const OstLocal s = halo->send_start[k];
        const OstLocal r = halo->receive_start[k];
        OST_TRY_DONE(OST_MPI(ctx, MPI_Irecv(asked + s, halo->send_start[k + 1] - s, MPI_INT64_T, halo->neighbour[k],
                                            HALO_TAG, ost_comm(ctx), &halo->request[requests++])));
        OST_TRY_DONE(OST_MPI(ctx, MPI_Isend(ghost_number + r, halo->receive_start[k + 1] - r, MPI_INT64_T,
                                            halo->neighbour[k], HALO_TAG, ost_comm(ctx), &halo->request[requests++])));
    }
    OST_TRY_DONE(OST_MPI(ctx, MPI_Waitall(requests, halo->request, MPI_STATUSES_IGNORE)));
    for (OstLocal i = 0; i < sends; i++)
        halo->send_index[i] = (OstLocal)(asked[i] - first_number);
done:
    OST_FREE(asked);
    return status;
}

OstStatus ost_halo_create(OstContext *ctx, OstLocal owned, OstGlobal first_number, OstLocal ghosts,
                          const OstGlobal *ghost_number, OstHalo **halo)
{
    const int size = ost_size(ctx);
    OstGlobal *end = NULL;
    int *send_count = NULL;
    int *receive_count = NULL;
    OstHalo *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    *halo = NULL;
    OST_THEN(OST_NEW(ctx, &end, size));
    OST_THEN(OST_NEW(ctx, &send_count, size));
    OST_THEN(OST_NEW(ctx, &receive_count, size));
    OST_TRY_DONE(ost_agree(ctx, status));
    made->ctx = ctx;
    made->owned = owned;
    made->ghosts = ghosts;
    OST_TRY_DONE(ost_number_ends(ctx, first_number + owned, end));
    OST_TRY_DONE(ost_agree(ctx, check_ghosts(ctx, end, ghosts, ghost_number, receive_count)));
    ost_ledger_gathered(ctx, (double)size * sizeof *send_count);
    OST_TRY_DONE(OST_MPI(ctx, MPI_Alltoall(receive_count, 1, MPI_INT, send_count, 1, MPI_INT, ost_comm(ctx))));
    OST_TRY_DONE(ost_agree(ctx, make_lists(made, send_count, receive_count)));
    OST_TRY_DONE(ost_agree(ctx, exchange_requests(made, first_number, ghost_number)));
    OST_TRY_DONE(ost_agree(ctx, reserve_buffer(made)));
done:
    OST_FREE(end, send_count, receive_count);
    if (status != OST_SUCCESS)
        ost_halo_destroy(&made);
    *halo = made;
    return status;
}

static void keep_entries(const OstHalo *halo, const OstLocal *renumber, OstHalo *subset)
{
    for (int k = 0; k < halo->neighbour_count; k++) {
        OstLocal sends = subset->send_start[k];
        OstLocal receives = subset->receive_start[k];
        for (OstLocal i = halo->send_start[k]; i < halo->send_start[k + 1]; i++)
            if (renumber[halo->send_index[i]] >= 0)
                subset->send_index[sends++] = renumber[halo->send_index[i]];
        for (OstLocal i = halo->receive_start[k]; i < halo->receive_start[k + 1]; i++)
            receives += renumber[halo->owned + i] >= 0;
        subset->neighbour[k] = halo->neighbour[k];
        subset->send_start[k + 1] = sends;
        subset->receive_start[k + 1] = receives;
    }
}

OstStatus ost_halo_subset(const OstHalo *halo, const OstLocal *renumber, OstHalo **subset)
{
    OstContext *ctx = halo->ctx;
    const int n = halo->neighbour_count;
    OstHalo *made = NULL;
    *subset = NULL;
    OST_TRY(OST_NEW(ctx, &made, 1));
    OstStatus status = OST_SUCCESS;
    made->ctx = ctx;
    made->neighbour_count = n;
    OST_TRY_DONE(OST_NEW(ctx, &made->neighbour, n));
    OST_TRY_DONE(OST_NEW(ctx, &made->send_start, n + 1));
    OST_TRY_DONE(OST_NEW(ctx, &made->receive_start, n + 1));
    OST_TRY_DONE(OST_NEW(ctx, &made->request, 2 * n));
    OST_TRY_DONE(OST_NEW(ctx, &made->send_index, halo->send_start[n]));
    keep_entries(halo, renumber, made);
    for (OstLocal i = 0; i < halo->owned; i++)
        made->owned += renumber[i] >= 0;
    made->ghosts = made->receive_start[n];
    OST_TRY_DONE(reserve_buffer(made));
done:
    if (status != OST_SUCCESS)
        ost_halo_destroy(&made);
    *subset = made;
    return status;
}

int ost_halo_messages(const OstHalo *halo, const OstLocal *start)
{
    int messages = 0;
    for (int k = 0; k < halo->neighbour_count; k++)
        messages += start[k + 1] > start[k];
    return messages;
}

/* All ranks fail together, since `size` is the same on all. */
static OstStatus check_entry(const OstHalo *halo, size_t size)
{
    if (size <= OST_LARGEST_ENTRY)
        return OST_SUCCESS;
    return OST_RAISE(halo->ctx, OST_INVALID_INPUT, "a halo carries entries of at most %d bytes, not %zu",
                     (int)OST_LARGEST_ENTRY, size);
}

/* Posts the receives, or the sends, of all neighbours: for k the entries from start[k] on, of `size` bytes each. */
static OstStatus post(OstHalo *halo, int sends, size_t size, const OstLocal *start, char *entries, int *requests)
{
    MPI_Comm comm = ost_comm(halo->ctx);
    for (int k = 0; k < halo->neighbour_count; k++) { /* the length fits an int: reserve_buffer has checked it */
        const int to = halo->neighbour[k], length = (int)((size_t)(start[k + 1] - start[k]) * size);
        char *bytes = entries + (size_t)start[k] * size;
        MPI_Request *request = &halo->request[*requests];
        if (length == 0)
            continue;
        if (sends)
            OST_TRY(OST_MPI(halo->ctx, MPI_Isend(bytes, length, MPI_BYTE, to, HALO_TAG, comm, request)));
        else
            OST_TRY(OST_MPI(halo->ctx, MPI_Irecv(bytes, length, MPI_BYTE, to, HALO_TAG, comm, request)));
        ++*requests;
    }
    return OST_SUCCESS;
}

OstStatus ost_halo_import(OstHalo *halo, size_t size, void *values)
{
    const int n = halo->neighbour_count;
    if (n == 0)
        return OST_SUCCESS;
    OST_TRY(check_entry(halo, size));
    char *bytes = values, *outgoing = halo->buffer;
    int requests = 0;
    OST_TRY(post(halo, 0, size, halo->receive_start, bytes + (size_t)halo->owned * size, &requests));
    for (OstLocal i = 0; i < halo->send_start[n]; i++)
        memcpy(outgoing + (size_t)i * size, bytes + (size_t)halo->send_index[i] * size, size);
    OST_TRY(post(halo, 1, size, halo->send_start, outgoing, &requests));
    ost_ledger_sent(halo->ctx, ost_halo_messages(halo, halo->send_start), (double)size * halo->send_start[n]);
    return OST_MPI(halo->ctx, MPI_Waitall(requests, halo->request, MPI_STATUSES_IGNORE));
}

/* Of an owner's value and a ghost's. */
typedef double Combine(double owners, double ghosts);

static double add(double owners, double ghosts)
{
    return owners + ghosts;
}

static OstStatus combine(OstHalo *halo, int width, double *values, Combine *with)
{
    const int n = halo->neighbour_count;
    if (n == 0)
        return OST_SUCCESS;
    const size_t size = (size_t)width * sizeof(double);
    OST_TRY(check_entry(halo, size));
    const double *incoming = halo->buffer;
    int requests = 0;
    OST_TRY(post(halo, 0, size, halo->send_start, halo->buffer, &requests));
    OST_TRY(
        post(halo, 1, size, halo->receive_start, (char *)(values + (size_t)halo->owned * (size_t)width), &requests));
    ost_ledger_sent(halo->ctx, ost_halo_messages(halo, halo->receive_start), (double)size * halo->ghosts);
    OST_TRY(OST_MPI(halo->ctx, MPI_Waitall(requests, halo->request, MPI_STATUSES_IGNORE)));
    for (OstLocal i = 0; i < halo->send_start[n]; i++)
        for (int c = 0; c < width; c++) {
            double *value = &values[(size_t)halo->send_index[i] * (size_t)width + (size_t)c];
            *value = with(*value, incoming[(size_t)i * (size_t)width + (size_t)c]);
        }
    return OST_SUCCESS;
}

OstStatus ost_halo_add_to_owners(OstHalo *halo, int width, double *values)
{
    return combine(halo, width, values, add);
}

OstStatus ost_halo_max_at_owners(OstHalo *halo, int width, double *values)
{
    return combine(halo, width, values, fmax);
}

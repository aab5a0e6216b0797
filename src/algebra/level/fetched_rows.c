/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/fetched_rows.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>

enum { ROWS_TAG = 7272, PADDING = 64 };

void ost_fetched_rows_destroy(OstFetchedRows **rows)
{
    if (!*rows)
        return;
    OST_FREE((*rows)->start, (*rows)->column, (*rows)->value);
    OST_FREE(*rows);
}

OstStatus ost_fetched_rows_create(OstContext *ctx, OstLocal rows, size_t block_bytes, OstFetchedRows **made)
{
    OST_TRY(OST_NEW(ctx, made, 1));
    (*made)->ctx = ctx;
    (*made)->block_bytes = block_bytes;
    (*made)->rows = rows;
    const OstStatus status = OST_NEW(ctx, &(*made)->start, (size_t)rows + 1);
    if (status != OST_SUCCESS)
        ost_fetched_rows_destroy(made);
    return status;
}

OstStatus ost_fetched_rows_reserve(OstFetchedRows *rows)
{
    const size_t blocks = (size_t)rows->start[rows->rows];
    OST_TRY(OST_NEW(rows->ctx, &rows->column, blocks));
    return OST_NEW(rows->ctx, &rows->value, blocks * rows->block_bytes + PADDING);
}

/* The exchange of one array: what is sent to and received from each neighbour, in items of `bytes`. */
typedef struct Parcel {
    const OstLocal *out_start, *in_start; /* neighbours + 1 */
    size_t bytes;
    const void *out;
    void *in;
} Parcel;

/* Where each neighbour's blocks start. MPI counts their bytes in an int. */
static OstStatus find_blocks(const OstHalo *halo, const OstLocal *row_start, const OstFetchedRows *rows,
                             OstLocal *blocks)
{
    for (int k = 0; k <= halo->neighbour_count; k++) {
        blocks[k] = rows->start[row_start[k]];
        const size_t length = k > 0 ? (size_t)(blocks[k] - blocks[k - 1]) * rows->block_bytes : 0;
        if (length > INT_MAX)
            return OST_RAISE(halo->ctx, OST_LIMIT_EXCEEDED,
                             "a message of %zu bytes exceeds MPI's 2^31 - 1; use more ranks", length);
    }
    return OST_SUCCESS;
}

static OstStatus send_parcel(OstHalo *halo, const Parcel *parcel)
{
    OstContext *ctx = halo->ctx;
    const size_t bytes = parcel->bytes;
    int requests = 0;
    for (int k = 0; k < halo->neighbour_count; k++) {
        const OstLocal from = parcel->in_start[k], end = parcel->in_start[k + 1];
        OST_TRY(
            OST_MPI(ctx, MPI_Irecv((char *)parcel->in + (size_t)from * bytes, (int)((size_t)(end - from) * bytes),
                                   MPI_BYTE, halo->neighbour[k], ROWS_TAG, ost_comm(ctx), &halo->request[requests++])));
    }
    for (int k = 0; k < halo->neighbour_count; k++) {
        const OstLocal from = parcel->out_start[k], end = parcel->out_start[k + 1];
        OST_TRY(OST_MPI(ctx,
                        MPI_Isend((const char *)parcel->out + (size_t)from * bytes, (int)((size_t)(end - from) * bytes),
                                  MPI_BYTE, halo->neighbour[k], ROWS_TAG, ost_comm(ctx), &halo->request[requests++])));
    }
    return OST_MPI(ctx, MPI_Waitall(requests, halo->request, MPI_STATUSES_IGNORE));
}

/* Lengths of the rows: they say how many blocks follow. */
static OstStatus exchange_lengths(OstHalo *halo, const OstLocal *out_row, const OstLocal *in_row,
                                  const OstFetchedRows *out, OstFetchedRows *in)
{
    OstLocal *length = NULL;
    OstStatus status = ost_agree(halo->ctx, OST_NEW(halo->ctx, &length, out->rows));
    if (status != OST_SUCCESS)
        goto done;
    for (OstLocal i = 0; i < out->rows; i++)
        length[i] = out->start[i + 1] - out->start[i];
    OST_TRY_DONE(send_parcel(halo, &(Parcel){out_row, in_row, sizeof *length, length, in->start + 1}));
    for (OstLocal i = 0; i < in->rows; i++)
        in->start[i + 1] += in->start[i];
done:
    OST_FREE(length);
    return status;
}

static OstStatus exchange_blocks(OstHalo *halo, const OstLocal *out_row, const OstLocal *in_row,
                                 const OstFetchedRows *out, OstFetchedRows *in)
{
    const int starts = halo->neighbour_count + 1;
    OstLocal *out_block = NULL, *in_block = NULL;
    OstStatus status = OST_NEW(halo->ctx, &out_block, 2 * starts);
    if (status == OST_SUCCESS) {
        in_block = out_block + starts;
        status = find_blocks(halo, out_row, out, out_block);
    }
    OST_THEN(find_blocks(halo, in_row, in, in_block));
    OST_THEN(ost_fetched_rows_reserve(in));
    OST_TRY_DONE(ost_agree(halo->ctx, status));
    OST_TRY_DONE(send_parcel(halo, &(Parcel){out_block, in_block, sizeof *out->column, out->column, in->column}));
    OST_TRY_DONE(send_parcel(halo, &(Parcel){out_block, in_block, out->block_bytes, out->value, in->value}));
done:
    OST_FREE(out_block);
    return status;
}

OstStatus ost_fetched_rows_exchange(OstHalo *halo, OstDirection direction, const OstFetchedRows *out,
                                    OstFetchedRows **in)
{
    const OstLocal *out_row = direction == OST_TO_GHOSTS ? halo->send_start : halo->receive_start;
    const OstLocal *in_row = direction == OST_TO_GHOSTS ? halo->receive_start : halo->send_start;
    OstFetchedRows *made = NULL;
    *in = NULL;
    OstStatus status = ost_agree(
        halo->ctx, ost_fetched_rows_create(halo->ctx, in_row[halo->neighbour_count], out->block_bytes, &made));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_agree(halo->ctx, exchange_lengths(halo, out_row, in_row, out, made)));
    OST_TRY_DONE(ost_agree(halo->ctx, exchange_blocks(halo, out_row, in_row, out, made)));
done:
    if (status != OST_SUCCESS)
        ost_fetched_rows_destroy(&made);
    *in = made;
    return status;
}

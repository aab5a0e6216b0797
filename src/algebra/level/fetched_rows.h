/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_FETCHED_ROWS_H
#define ORTHOSTAT_ALGEBRA_LEVEL_FETCHED_ROWS_H

#include "core/parallel/halo.h"

/* Rows of blocks on their way between ranks; columns by their global numbers. */
typedef struct OstFetchedRows {
    OstContext *ctx;
    size_t block_bytes;
    OstLocal rows;
    OstLocal *start;   /* rows + 1 */
    OstGlobal *column; /* start[rows] */
    char *value;       /* start[rows] × block_bytes, and padding */
} OstFetchedRows;

/* Which way along a halo: from owners to the ranks that hold copies, or back. */
typedef enum { OST_TO_GHOSTS, OST_TO_OWNERS } OstDirection;

/* Local. Rows of which `start` is still to be filled, and then the room for what it says is there. */
OstStatus ost_fetched_rows_create(OstContext *ctx, OstLocal rows, size_t block_bytes, OstFetchedRows **made);
OstStatus ost_fetched_rows_reserve(OstFetchedRows *rows);
void ost_fetched_rows_destroy(OstFetchedRows **rows);

/* Collective. Rows are in the order of the halo: on the owners' side one for every entry of send_index, on the others'
 * one for every ghost. */
OstStatus ost_fetched_rows_exchange(OstHalo *halo, OstDirection direction, const OstFetchedRows *out,
                                    OstFetchedRows **in);

#endif

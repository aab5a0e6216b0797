/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_FETCHED_ROWS_H
#define ORTHOSTAT_ALGEBRA_LEVEL_FETCHED_ROWS_H

#include "core/parallel/halo.h"

/* Rows of blocks that ranks exchange; columns are global numbers. */
typedef struct OstFetchedRows {
    OstContext *ctx;
    size_t block_bytes;
    OstLocal rows;
    OstLocal *start;   /* rows + 1 */
    OstGlobal *column; /* start[rows] */
    char *value;       /* start[rows] × block_bytes, and padding */
} OstFetchedRows;

/* Direction along a halo: from owners to ghosts, or back. */
typedef enum { OST_TO_GHOSTS, OST_TO_OWNERS } OstDirection;

/* Local. Create, fill `start`, then reserve: that allocates the columns and values which `start` counts. */
OstStatus ost_fetched_rows_create(OstContext *ctx, OstLocal rows, size_t block_bytes, OstFetchedRows **made);
OstStatus ost_fetched_rows_reserve(OstFetchedRows *rows);
void ost_fetched_rows_destroy(OstFetchedRows **rows);

/* Collective. Rows are in the order of the halo: on the owners' side one per entry of send_index, on the other side one
 * per ghost. */
OstStatus ost_fetched_rows_exchange(OstHalo *halo, OstDirection direction, const OstFetchedRows *out,
                                    OstFetchedRows **in);

#endif

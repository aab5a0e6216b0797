/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/block_sum.h"

#include "algebra/level/fetched_rows.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"

#include <string.h>

enum { BLOCK = OST_BLOCK };

OstStatus ost_block_sum_create(OstContext *ctx, OstGlobal first, OstLocal owned, OstBlockSum **sum)
{
    OST_TRY(OST_NEW(ctx, sum, 1));
    **sum = (OstBlockSum){.ctx = ctx, .first = first, .owned = owned};
    OstStatus status = ost_index_create(ctx, 1, &(*sum)->ghost);
    OST_THEN(ost_index_create(ctx, 1, &(*sum)->entry));
    if (status != OST_SUCCESS)
        ost_block_sum_destroy(sum);
    return status;
}

void ost_block_sum_destroy(OstBlockSum **sum)
{
    if (!*sum)
        return;
    ost_index_destroy(&(*sum)->ghost);
    ost_index_destroy(&(*sum)->entry);
    OST_FREE_EACH((*sum)->chunks, (*sum)->chunk);
    OST_FREE(*sum);
}

OstStatus ost_block_sum_number(OstBlockSum *sum, OstGlobal number, OstLocal *node)
{
    if (number >= sum->first && number < sum->first + sum->owned) {
        *node = (OstLocal)(number - sum->first);
        return OST_SUCCESS;
    }
    OST_TRY(ost_index_place(sum->ghost, &number, node));
    *node += sum->owned;
    return OST_SUCCESS;
}

static OstStatus add_chunk(OstBlockSum *sum)
{
    if (sum->chunks == sum->room) {
        const OstLocal room = 2 * sum->room + 16;
        OST_TRY(OST_RESIZE(sum->ctx, &sum->chunk, room));
        sum->room = room;
    }
    OST_TRY(OST_NEW(sum->ctx, &sum->chunk[sum->chunks], BLOCK * OST_CHUNK));
    sum->chunks++;
    return OST_SUCCESS;
}

OstStatus ost_block_sum_find(OstBlockSum *sum, OstLocal row, OstLocal column, double **block)
{
    const OstGlobal key = (OstGlobal)row << 32 | column;
    OstLocal place;
    OST_TRY(ost_index_place(sum->entry, &key, &place));
    if (place / OST_CHUNK >= sum->chunks)
        OST_TRY(add_chunk(sum));
    *block = ost_chunk_block(sum->chunk, place);
    return OST_SUCCESS;
}

static OstLocal row_of(const OstBlockSum *sum, OstLocal entry)
{
    return (OstLocal)(sum->entry->key[entry] >> 32);
}

static OstLocal column_of(const OstBlockSum *sum, OstLocal entry)
{
    return (OstLocal)(sum->entry->key[entry] & 0xffffffff);
}

static OstGlobal number_of(const OstBlockSum *sum, OstLocal node)
{
    return node < sum->owned ? sum->first + node : sum->ghost->key[node - sum->owned];
}

/* The blocks summed in the rows of ghosts. */
static OstStatus pack(const OstBlockSum *sum, OstFetchedRows *out)
{
    const OstLocal entries = sum->entry->count;
    OstLocal *next = NULL;
    OST_TRY(OST_NEW(sum->ctx, &next, out->rows));
    for (OstLocal e = 0; e < entries; e++)
        if (row_of(sum, e) >= sum->owned)
            out->start[row_of(sum, e) - sum->owned + 1]++;
    for (OstLocal g = 0; g < out->rows; g++) {
        next[g] = out->start[g];
        out->start[g + 1] += out->start[g];
    }
    const OstStatus status = ost_fetched_rows_reserve(out);
    double *value = (double *)(void *)out->value;
    for (OstLocal e = 0; e < entries && status == OST_SUCCESS; e++) {
        if (row_of(sum, e) < sum->owned)
            continue;
        const OstLocal k = next[row_of(sum, e) - sum->owned]++;
        out->column[k] = number_of(sum, column_of(sum, e));
        memcpy(value + BLOCK * (size_t)k, ost_chunk_block(sum->chunk, e), BLOCK * sizeof *value);
    }
    OST_FREE(next);
    return status;
}

static OstStatus add(OstBlockSum *sum, const OstLocal *row, const OstFetchedRows *in)
{
    const double *value = (const double *)(const void *)in->value;
    for (OstLocal i = 0; i < in->rows; i++)
        for (OstLocal k = in->start[i]; k < in->start[i + 1]; k++) {
            OstLocal column;
            double *block;
            OST_TRY(ost_block_sum_number(sum, in->column[k], &column));
            if (ost_block_sum_is_mirrored(sum, row[i], column))
                continue;
            OST_TRY(ost_block_sum_find(sum, row[i], column, &block));
            for (int c = 0; c < BLOCK; c++)
                block[c] += value[BLOCK * (size_t)k + (size_t)c];
        }
    return OST_SUCCESS;
}

OstStatus ost_block_sum_return(OstBlockSum *sum, OstHalo *halo)
{
    OstContext *ctx = sum->ctx;
    OstFetchedRows *out = NULL, *in = NULL;
    OstStatus status = ost_fetched_rows_create(ctx, halo->ghosts, BLOCK * sizeof(double), &out);
    OST_THEN(pack(sum, out));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_fetched_rows_exchange(halo, OST_TO_OWNERS, out, &in));
    OST_TRY_DONE(ost_agree(ctx, add(sum, halo->send_index, in)));
done:
    ost_fetched_rows_destroy(&out);
    ost_fetched_rows_destroy(&in);
    return status;
}

/* The rows of the matrix as lists of blocks: entry e, or ~e for the transpose of entry e. */
typedef struct Listing {
    OstLocal *start;    /* owned + 2, the last one scratch; becomes the matrix's row_start */
    OstLocal *block;    /* start[owned]; becomes the matrix's place */
    OstLocal *renumber; /* local number here -> column of the matrix */
    OstGlobal *ghost;   /* global numbers of the matrix's ghosts, ascending */
    OstLocal columns;
} Listing;

static OstStatus list_rows(const OstBlockSum *sum, Listing *list)
{
    const OstLocal entries = sum->entry->count;
    OST_TRY(OST_NEW(sum->ctx, &list->start, sum->owned + 2));
    OST_TRY(OST_NEW(sum->ctx, &list->block, 2 * (size_t)entries));
    OstLocal *next = list->start + 1; /* becomes the next row's start while it is filled */
    for (OstLocal e = 0; e < entries; e++) {
        const OstLocal row = row_of(sum, e), column = column_of(sum, e);
        if (row < sum->owned)
            next[row + 1]++;
        if (row < column && column < sum->owned)
            next[column + 1]++;
    }
    for (OstLocal i = 0; i < sum->owned; i++)
        next[i + 1] += next[i];
    for (OstLocal e = 0; e < entries; e++) {
        const OstLocal row = row_of(sum, e), column = column_of(sum, e);
        if (row < sum->owned)
            list->block[next[row]++] = e;
        if (row < column && column < sum->owned)
            list->block[next[column]++] = ~e;
    }
    return OST_SUCCESS;
}

/* Drops the ghosts that no row of the matrix needs and sorts the others. */
static OstStatus number_columns(const OstBlockSum *sum, Listing *list)
{
    const OstLocal ghosts = sum->ghost->count;
    OstLocal kept = 0;
    OST_TRY(OST_NEW(sum->ctx, &list->renumber, sum->owned + ghosts));
    OST_TRY(OST_NEW(sum->ctx, &list->ghost, ghosts));
    for (OstLocal e = 0; e < sum->entry->count; e++)
        if (row_of(sum, e) < sum->owned)
            list->renumber[column_of(sum, e)] = 1;
    for (OstLocal g = 0; g < ghosts; g++)
        if (list->renumber[sum->owned + g])
            list->ghost[kept++] = sum->ghost->key[g];
    kept = ost_numbers_sort(kept, list->ghost);
    for (OstLocal i = 0; i < sum->owned; i++)
        list->renumber[i] = i;
    for (OstLocal g = 0; g < ghosts; g++)
        if (list->renumber[sum->owned + g])
            list->renumber[sum->owned + g] = sum->owned + ost_numbers_find(kept, list->ghost, sum->ghost->key[g]);
    list->columns = sum->owned + kept;
    return OST_SUCCESS;
}

/* Sorts a row's blocks by column; by insertion, as rows are short. */
static void sort_row(const OstBlockSum *sum, const Listing *list, OstLocal i, OstLocal *column)
{
    for (OstLocal k = list->start[i]; k < list->start[i + 1]; k++) {
        const OstLocal b = list->block[k];
        const OstLocal c = b >= 0 ? list->renumber[column_of(sum, b)] : row_of(sum, ~b);
        OstLocal to = k;
        for (; to > list->start[i] && column[to - 1] > c; to--) {
            column[to] = column[to - 1];
            list->block[to] = list->block[to - 1];
        }
        column[to] = c;
        list->block[to] = b;
    }
}

static OstStatus fill(OstBlockSum *sum, Listing *list, OstDoubleMatrix **matrix)
{
    OST_TRY(list_rows(sum, list));
    OST_TRY(number_columns(sum, list));
    const OstLocal blocks = list->start[sum->owned];
    OST_TRY(OST_NEW(sum->ctx, matrix, 1));
    **matrix = (OstDoubleMatrix){.ctx = sum->ctx, .size = OST_MODES, .rows = sum->owned, .columns = list->columns};
    OST_TRY(OST_NEW(sum->ctx, &(*matrix)->column, blocks));
    for (OstLocal i = 0; i < sum->owned; i++)
        sort_row(sum, list, i, (*matrix)->column);
    (*matrix)->chunk = sum->chunk;
    (*matrix)->chunks = sum->chunks;
    (*matrix)->place = list->block;
    (*matrix)->row_start = list->start;
    sum->chunk = NULL;
    sum->chunks = sum->room = 0;
    list->start = list->block = NULL;
    return OST_SUCCESS;
}

OstStatus ost_block_sum_finish(OstBlockSum *sum, OstDoubleMatrix **matrix)
{
    OstContext *ctx = sum->ctx;
    Listing list = {0};
    *matrix = NULL;
    OstStatus status = ost_agree(ctx, fill(sum, &list, matrix));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_halo_create(ctx, sum->owned, sum->first, list.columns - sum->owned, list.ghost, &(*matrix)->halo));
done:
    OST_FREE(list.start, list.block, list.renumber, list.ghost);
    if (status != OST_SUCCESS)
        ost_double_matrix_destroy(matrix);
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_ml_copy.h"

#include "core/error.h"
#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

/* An operator of ML on its way into blocks. */
typedef struct Copy {
    ML_Operator *source;
    OstMetricOperator *op;
    OstLocal owned;          /* block columns of this rank */
    OstLocal ghosts;         /* block columns of others */
    OstGlobal first;         /* global number of owned column 0 */
    OstGlobal *ghost_number; /* ghosts, ascending */
    OstLocal scalar_ghosts;  /* ML's ghosts */
    OstGlobal *scalar_number;
    OstLocal *place; /* op->columns: where a column's block is in the row being copied, if >= the row's start */
    OstLocal room;   /* blocks */
    int row_room;
    int *row_column;
    double *row_value;
} Copy;

static OstStatus measure_columns(OstContext *ctx, Copy *copy)
{
    const OstMetricOperator *op = copy->op;
    if (copy->source->outvec_leng % op->height != 0 || copy->source->invec_leng % op->width != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML made an operator of %d × %d; expected blocks of %d × %d",
                         copy->source->outvec_leng, copy->source->invec_leng, op->height, op->width);
    copy->owned = copy->source->invec_leng / op->width;
    ML_CommInfoOP *exchange = copy->source->getrow->pre_comm;
    copy->scalar_ghosts = exchange ? ML_CommInfoOP_Compute_TotalRcvLength(exchange) : 0;
    return OST_NEW(ctx, &copy->scalar_number, copy->scalar_ghosts);
}

/* Owners tell the global numbers of their unknowns through ML's own exchange, which carries doubles: exact to 2^53. */
static OstStatus number_ghosts(OstContext *ctx, Copy *copy)
{
    const OstLocal owned = copy->source->invec_leng;
    const OstGlobal columns = copy->owned;
    OstGlobal end = 0;
    double *number = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &number, (size_t)owned + (size_t)copy->scalar_ghosts)));
    OstStatus status = OST_MPI(ctx, MPI_Scan(&columns, &end, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx)));
    copy->first = end - columns;
    for (OstLocal i = 0; i < owned; i++)
        number[i] = (double)(copy->first * copy->op->width + i);
    if (copy->source->getrow->pre_comm)
        ML_exchange_bdry(number, copy->source->getrow->pre_comm, owned, copy->source->comm, ML_OVERWRITE, NULL);
    for (OstLocal g = 0; g < copy->scalar_ghosts; g++)
        copy->scalar_number[g] = (OstGlobal)number[owned + g];
    OST_FREE(number);
    return status;
}

static int compare_numbers(const void *a, const void *b)
{
    const OstGlobal x = *(const OstGlobal *)a;
    const OstGlobal y = *(const OstGlobal *)b;
    return (x > y) - (x < y);
}

/* The nodes that ML's ghosts belong to, each once. */
static OstStatus list_ghost_nodes(OstContext *ctx, Copy *copy)
{
    OST_TRY(OST_NEW(ctx, &copy->ghost_number, copy->scalar_ghosts));
    for (OstLocal g = 0; g < copy->scalar_ghosts; g++)
        copy->ghost_number[g] = copy->scalar_number[g] / copy->op->width;
    qsort(copy->ghost_number, (size_t)copy->scalar_ghosts, sizeof *copy->ghost_number, compare_numbers);
    for (OstLocal g = 0; g < copy->scalar_ghosts; g++)
        if (copy->ghosts == 0 || copy->ghost_number[g] != copy->ghost_number[copy->ghosts - 1])
            copy->ghost_number[copy->ghosts++] = copy->ghost_number[g];
    copy->op->columns = copy->owned + copy->ghosts;
    return OST_SUCCESS;
}

/* Block column and place within it of one of ML's scalar columns. */
static OstLocal block_column(const Copy *copy, int scalar, int *place)
{
    const int width = copy->op->width;
    if (scalar < copy->source->invec_leng) {
        *place = scalar % width;
        return scalar / width;
    }
    const OstGlobal number = copy->scalar_number[scalar - copy->source->invec_leng];
    const OstGlobal node = number / width;
    *place = (int)(number % width);
    const OstGlobal *found = bsearch(&node, copy->ghost_number, (size_t)copy->ghosts, sizeof node, compare_numbers);
    return copy->owned + (OstLocal)(found - copy->ghost_number);
}

static OstStatus reserve_block(Copy *copy, OstLocal blocks)
{
    if (blocks < copy->room)
        return OST_SUCCESS;
    const size_t room = (size_t)copy->room + (size_t)copy->room / 2 + 256;
    const size_t size = (size_t)(copy->op->height * copy->op->width);
    OST_TRY(OST_RESIZE(copy->op->ctx, &copy->op->column, room));
    OST_TRY(OST_RESIZE(copy->op->ctx, &copy->op->exact, size * room));
    copy->room = (OstLocal)room;
    return OST_SUCCESS;
}

static OstStatus get_scalar_row(Copy *copy, int row, int *length)
{
    while (!ML_Operator_Getrow(copy->source, 1, &row, copy->row_room, copy->row_column, copy->row_value, length)) {
        copy->row_room = 2 * copy->row_room + 256;
        OST_TRY(OST_RESIZE(copy->op->ctx, &copy->row_column, copy->row_room));
        OST_TRY(OST_RESIZE(copy->op->ctx, &copy->row_value, copy->row_room));
    }
    return OST_SUCCESS;
}

/* Adds the scalar rows of block row i behind the `*blocks` blocks there are, in the order they come. */
static OstStatus copy_row(Copy *copy, OstLocal i, OstLocal *blocks)
{
    OstMetricOperator *op = copy->op;
    const size_t size = (size_t)(op->height * op->width);
    const OstLocal start = *blocks;
    for (int r = 0; r < op->height; r++) {
        int length = 0;
        OST_TRY(get_scalar_row(copy, op->height * i + r, &length));
        for (int k = 0; k < length; k++) {
            int c;
            const OstLocal column = block_column(copy, copy->row_column[k], &c);
            if (copy->place[column] < start) {
                OST_TRY(reserve_block(copy, *blocks));
                memset(op->exact + size * (size_t)*blocks, 0, size * sizeof(double));
                op->column[*blocks] = column;
                copy->place[column] = (*blocks)++;
            }
            op->exact[size * (size_t)copy->place[column] + (size_t)(c * op->height + r)] += copy->row_value[k];
        }
    }
    return OST_SUCCESS;
}

/* Insertion sort of a row's blocks by column: rows are short and nearly in order. */
static void sort_row(OstMetricOperator *op, OstLocal start, OstLocal end)
{
    const size_t size = (size_t)(op->height * op->width);
    double block[36];
    for (OstLocal k = start + 1; k < end; k++) {
        const OstLocal column = op->column[k];
        OstLocal to = k;
        while (to > start && op->column[to - 1] > column)
            to--;
        if (to == k)
            continue;
        memcpy(block, op->exact + size * (size_t)k, size * sizeof *block);
        memmove(op->exact + size * (size_t)(to + 1), op->exact + size * (size_t)to,
                size * (size_t)(k - to) * sizeof *block);
        memmove(op->column + to + 1, op->column + to, (size_t)(k - to) * sizeof column);
        memcpy(op->exact + size * (size_t)to, block, size * sizeof *block);
        op->column[to] = column;
    }
}

static OstStatus copy_rows(OstContext *ctx, Copy *copy, int exact)
{
    OstMetricOperator *op = copy->op;
    OstLocal blocks = 0;
    copy->row_room = 1024;
    OST_TRY(OST_NEW(ctx, &copy->row_column, copy->row_room));
    OST_TRY(OST_NEW(ctx, &copy->row_value, copy->row_room));
    OST_TRY(OST_NEW(ctx, &copy->place, op->columns));
    OST_TRY(OST_NEW(ctx, &op->row_start, op->rows + 1));
    for (OstLocal c = 0; c < op->columns; c++)
        copy->place[c] = -1;
    copy->room = copy->source->N_nonzeros > 0 ? copy->source->N_nonzeros / (op->height * op->width) : 0;
    OST_TRY(reserve_block(copy, copy->room));
    for (OstLocal i = 0; i < op->rows; i++) {
        OST_TRY(copy_row(copy, i, &blocks));
        sort_row(op, op->row_start[i], blocks);
        op->row_start[i + 1] = blocks;
    }
    return ost_metric_operator_round(op, exact);
}

OstStatus ost_metric_operator_from_ml(OstContext *ctx, ML_Operator *source, int height, int width, int exact,
                                      OstMetricOperator **op)
{
    Copy copy = {.source = source};
    *op = NULL;
    OstStatus status = OST_NEW(ctx, &copy.op, 1);
    if (status == OST_SUCCESS) {
        copy.op->ctx = ctx;
        copy.op->height = height;
        copy.op->width = width;
        copy.op->rows = source->outvec_leng / height;
        status = measure_columns(ctx, &copy);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_agree(ctx, number_ghosts(ctx, &copy)));
    OST_TRY_DONE(ost_agree(ctx, list_ghost_nodes(ctx, &copy)));
    OST_TRY_DONE(ost_halo_create(ctx, copy.owned, copy.first, copy.ghosts, copy.ghost_number, &copy.op->halo));
    OST_TRY_DONE(ost_agree(ctx, copy_rows(ctx, &copy, exact)));
done:
    OST_FREE(copy.ghost_number);
    OST_FREE(copy.scalar_number);
    OST_FREE(copy.place);
    OST_FREE(copy.row_column);
    OST_FREE(copy.row_value);
    if (status != OST_SUCCESS)
        ost_metric_operator_destroy(&copy.op);
    *op = copy.op;
    return status;
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/galerkin.h"

#include "algebra/level/block_sum.h"
#include "algebra/level/fetched_rows.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"

#include <string.h>

enum { WIDTH = OST_MODES };

/* The product under construction. */
typedef struct Product {
    OstContext *ctx;
    const OstDoubleMatrix *a;
    const OstSmootherBlocks *blocks;
    const OstProlongator *p;
    OstBlockSum *sum;     /* numbers coarse nodes as the prolongator does, then others as they appear */
    OstFetchedRows *far;  /* the rows of P of A's ghosts */
    OstLocal *far_column; /* their columns */
    double *p_column;     /* one column of the block's rows of P */
    /* the rows of A P of the current block: */
    OstLocal *place, *column, count; /* place: of each coarse node among the `count` columns, or -1 */
    OstRow6 *rows;                   /* column by column, each `height` high */
    size_t height, room;             /* room: of `rows` */
} Product;

static void destroy_product(Product *product)
{
    ost_block_sum_destroy(&product->sum);
    ost_fetched_rows_destroy(&product->far);
    OST_FREE(product->far_column, product->place, product->column, product->p_column, product->rows);
}

/* The prolongator's columns appear in the sum first, in their order. `number`: their global numbers. */
static OstStatus number_columns(Product *product, OstGlobal **number)
{
    const OstProlongator *p = product->p;
    const OstLocal owned = product->sum->owned;
    OST_TRY(ost_agree(p->ctx, OST_NEW(p->ctx, number, p->columns)));
    for (OstLocal c = 0; c < owned; c++)
        (*number)[c] = product->sum->first + c;
    OstStatus status = ost_halo_import(p->halo, sizeof **number, *number);
    OstLocal column = 0;
    for (OstLocal c = owned; c < p->columns && status == OST_SUCCESS; c++)
        status = ost_block_sum_number(product->sum, (*number)[c], &column);
    return status;
}

/* The rows of P that other ranks need for their ghosts. */
static OstStatus pack_rows(const Product *product, const OstGlobal *number, OstFetchedRows *out)
{
    const OstProlongator *p = product->p;
    const OstLocal *node = product->a->halo->send_index;
    for (OstLocal i = 0; i < out->rows; i++)
        out->start[i + 1] = out->start[i] + p->row_start[node[i] + 1] - p->row_start[node[i]];
    OST_TRY(ost_fetched_rows_reserve(out));
    for (OstLocal i = 0; i < out->rows; i++) {
        const OstLocal from = p->row_start[node[i]];
        const size_t blocks = (size_t)(out->start[i + 1] - out->start[i]), entries = (size_t)(p->height * WIDTH);
        float *to = (float *)(void *)(out->value + (size_t)out->start[i] * out->block_bytes);
        for (size_t k = 0; k < blocks; k++)
            out->column[(size_t)out->start[i] + k] = number[p->column[(size_t)from + k]];
        memcpy(to, p->value + (size_t)from * entries, blocks * entries * sizeof *to);
        if (p->rest) /* behind the row */
            memcpy(to + blocks * entries, p->rest + (size_t)from * entries, blocks * entries * sizeof *to);
    }
    return OST_SUCCESS;
}

static OstStatus import_rows(Product *product, const OstGlobal *number)
{
    OstContext *ctx = product->ctx;
    OstHalo *halo = product->a->halo;
    const size_t bytes = (size_t)(product->p->height * WIDTH) * sizeof(float) * (product->p->rest ? 2 : 1);
    OstFetchedRows *out = NULL;
    OstStatus status = ost_fetched_rows_create(ctx, halo->send_start[halo->neighbour_count], bytes, &out);
    OST_THEN(pack_rows(product, number, out));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_fetched_rows_exchange(halo, OST_TO_GHOSTS, out, &product->far));
    const OstLocal blocks = product->far->start[product->far->rows];
    status = OST_NEW(ctx, &product->far_column, blocks);
    for (OstLocal k = 0; k < blocks && status == OST_SUCCESS; k++)
        status = ost_block_sum_number(product->sum, product->far->column[k], &product->far_column[k]);
    status = ost_agree(ctx, status);
done:
    ost_fetched_rows_destroy(&out);
    return status;
}

/* Appends a column of zeros for a coarse node. */
static OstStatus add_column(Product *product, OstLocal node)
{
    const size_t used = (size_t)product->count * product->height;
    if (used + product->height > product->room) {
        const size_t room = 2 * (used + product->height);
        OST_TRY(OST_RESIZE(product->ctx, &product->rows, room));
        product->room = room;
    }
    memset(product->rows + used, 0, product->height * sizeof *product->rows);
    product->place[node] = product->count;
    product->column[product->count++] = node;
    return OST_SUCCESS;
}

/* Adds a × the blocks of one row of P to the rows of A P from `row` on. */
OST_UNROLLED OstStatus add_blocks(Product *product, int size, size_t row, const double *a, OstLocal blocks,
                                  const OstLocal *column, const float *value)
{
    for (OstLocal k = 0; k < blocks; k++, value += size * WIDTH) {
        if (product->place[column[k]] < 0)
            OST_TRY(add_column(product, column[k]));
        ost_block_multiply(size, a, value, product->rows + product->height * (size_t)product->place[column[k]] + row);
    }
    return OST_SUCCESS;
}

/* Row i of A P. */
OST_UNROLLED OstStatus multiply_row(Product *product, int size, OstLocal i, size_t row)
{
    const OstDoubleMatrix *a = product->a;
    const OstProlongator *p = product->p;
    const OstFetchedRows *far = product->far;
    double room[OST_BLOCK];
    for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
        const double *value = ost_double_matrix_block(a, size, i, k, room);
        const OstLocal j = a->column[k];
        if (j < a->rows) {
            const OstLocal from = p->row_start[j];
            OST_TRY(add_blocks(product, size, row, value, p->row_start[j + 1] - from, p->column + from,
                               p->value + (size_t)(size * WIDTH) * (size_t)from));
            if (p->rest)
                OST_TRY(add_blocks(product, size, row, value, p->row_start[j + 1] - from, p->column + from,
                                   p->rest + (size_t)(size * WIDTH) * (size_t)from));
        } else {
            const OstLocal from = far->start[j - a->rows], blocks = far->start[j - a->rows + 1] - from;
            const float *row_of_p = (const float *)(const void *)(far->value + (size_t)from * far->block_bytes);
            OST_TRY(add_blocks(product, size, row, value, blocks, product->far_column + from, row_of_p));
            if (p->rest)
                OST_TRY(add_blocks(product, size, row, value, blocks, product->far_column + from,
                                   row_of_p + (size_t)(size * WIDTH) * (size_t)blocks));
        }
    }
    return OST_SUCCESS;
}

/* Column k of the block's rows of P, in double precision. */
OST_UNROLLED void take_column(Product *product, int size, OstLocal b, OstLocal k)
{
    const OstProlongator *p = product->p;
    const OstSmootherBlocks *blocks = product->blocks;
    double *to = product->p_column;
    for (OstLocal m = blocks->node_start[b]; m < blocks->node_start[b + 1]; m++, to += size * WIDTH) {
        const size_t from = (size_t)(size * WIDTH) * (size_t)(p->row_start[blocks->node[m]] + k);
        for (int e = 0; e < size * WIDTH; e++)
            to[e] = (double)p->value[from + (size_t)e] + (p->rest ? (double)p->rest[from + (size_t)e] : 0.0);
    }
}

/* block += pᵀ × (a column of A P) */
OST_UNROLLED void add_product(size_t height, const double *p, const OstRow6 *column, double *block)
{
    OstRow6 sum[WIDTH] = {{{0}, {0}}};
    for (size_t r = 0; r < height; r++)
        for (int c = 0; c < WIDTH; c++)
            ost_add_scaled_row6(p[WIDTH * r + (size_t)c], &column[r], &sum[c]);
    for (int c = 0; c < WIDTH; c++)
        ost_add_row6(&sum[c], block + WIDTH * c);
}

/* Adds (the block's rows of P)ᵀ × (those of A P) to the product. */
OST_UNROLLED OstStatus multiply_block(Product *product, int size, OstLocal b)
{
    const OstSmootherBlocks *blocks = product->blocks;
    const OstProlongator *p = product->p;
    const OstLocal first = blocks->node_start[b], nodes = blocks->node_start[b + 1] - first;
    const OstLocal start = p->row_start[blocks->node[first]];
    const OstLocal columns = p->row_start[blocks->node[first] + 1] - start;
    product->count = 0;
    product->height = (size_t)size * (size_t)nodes;
    for (OstLocal m = 0; m < nodes; m++)
        OST_TRY(multiply_row(product, size, blocks->node[first + m], (size_t)size * (size_t)m));
    for (OstLocal k = 0; k < columns; k++) {
        const OstLocal row = p->column[start + k];
        take_column(product, size, b, k);
        for (OstLocal m = 0; m < product->count; m++) {
            double *block;
            if (ost_block_sum_is_mirrored(product->sum, row, product->column[m]))
                continue;
            OST_TRY(ost_block_sum_find(product->sum, row, product->column[m], &block));
            add_product(product->height, product->p_column, product->rows + product->height * (size_t)m, block);
        }
    }
    for (OstLocal m = 0; m < product->count; m++)
        product->place[product->column[m]] = -1;
    return OST_SUCCESS;
}

OST_KERNEL static OstStatus multiply(Product *product)
{
    const OstSmootherBlocks *blocks = product->blocks;
    const size_t columns = (size_t)product->sum->owned + (size_t)product->sum->ghost->count;
    OstLocal largest = 0;
    for (OstLocal b = 0; b < blocks->count; b++) {
        const OstLocal nodes = blocks->node_start[b + 1] - blocks->node_start[b];
        largest = nodes > largest ? nodes : largest;
    }
    OST_TRY(OST_NEW(product->ctx, &product->place, columns));
    OST_TRY(OST_NEW(product->ctx, &product->column, columns));
    OST_TRY(OST_NEW(product->ctx, &product->p_column, (size_t)(product->a->size * WIDTH) * (size_t)largest));
    for (size_t c = 0; c < columns; c++)
        product->place[c] = -1;
    for (OstLocal b = 0; b < blocks->count; b++)
        if (product->a->size == 3)
            OST_TRY(multiply_block(product, 3, b));
        else
            OST_TRY(multiply_block(product, 6, b));
    return OST_SUCCESS;
}

OstStatus ost_galerkin_create(const OstDoubleMatrix *matrix, const OstSmootherBlocks *blocks,
                              const OstProlongator *prolongator, OstGlobal first_coarse, OstDoubleMatrix **coarse)
{
    OstContext *ctx = matrix->ctx;
    Product product = {.ctx = ctx, .a = matrix, .blocks = blocks, .p = prolongator};
    const OstLocal owned = prolongator->columns - prolongator->halo->ghosts;
    OstGlobal *number = NULL;
    *coarse = NULL;
    OstStatus status = ost_agree(ctx, ost_block_sum_create(ctx, first_coarse, owned, &product.sum));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_agree(ctx, number_columns(&product, &number)));
    OST_TRY_DONE(import_rows(&product, number));
    OST_TRY_DONE(ost_agree(ctx, multiply(&product)));
    OST_TRY_DONE(ost_block_sum_return(product.sum, prolongator->halo));
    OST_TRY_DONE(ost_block_sum_finish(product.sum, coarse));
done:
    OST_FREE(number);
    destroy_product(&product);
    return status;
}

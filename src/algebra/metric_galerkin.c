/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_galerkin.h"

#include "algebra/metric_block_sum.h"
#include "algebra/metric_rows.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

enum { WIDTH = OST_MODES, BLOCK = WIDTH * WIDTH };

/* The product in the making. */
typedef struct Product {
    OstContext *ctx;
    const OstExactMatrix *a;
    const OstProlongator *p;
    OstBlockSum *sum;     /* numbers coarse nodes as the prolongator does, then others as they are met */
    OstBlockRows *far;    /* the rows of P of A's ghosts */
    OstLocal *far_column; /* their columns */
    /* row i of A P: */
    OstLocal *place, *column, count; /* place: coarse nodes; where each is among the `count` columns, or -1 */
    OstDouble8 *row;
} Product;

static void destroy_product(Product *product)
{
    ost_block_sum_destroy(&product->sum);
    ost_block_rows_destroy(&product->far);
    OST_FREE(product->far_column);
    OST_FREE(product->place);
    OST_FREE(product->column);
    OST_FREE(product->row);
}

/* The sum meets the prolongator's columns first; `number` becomes their global numbers. */
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

/* The rows of P that A's ghosts stand for. */
static OstStatus pack_rows(const Product *product, const OstGlobal *number, OstBlockRows *out)
{
    const OstProlongator *p = product->p;
    const OstLocal *node = product->a->halo->send_index;
    for (OstLocal i = 0; i < out->rows; i++)
        out->start[i + 1] = out->start[i] + p->row_start[node[i] + 1] - p->row_start[node[i]];
    OST_TRY(ost_block_rows_reserve(out));
    for (OstLocal i = 0; i < out->rows; i++) {
        const OstLocal from = p->row_start[node[i]];
        const size_t blocks = (size_t)(out->start[i + 1] - out->start[i]);
        for (size_t k = 0; k < blocks; k++)
            out->column[(size_t)out->start[i] + k] = number[p->column[(size_t)from + k]];
        memcpy(out->value + (size_t)out->start[i] * out->block_bytes,
               (const char *)p->value + (size_t)from * out->block_bytes, blocks * out->block_bytes);
    }
    return OST_SUCCESS;
}

static OstStatus number_far_columns(Product *product)
{
    const OstLocal blocks = product->far->start[product->far->rows];
    OST_TRY(OST_NEW(product->ctx, &product->far_column, blocks));
    for (OstLocal k = 0; k < blocks; k++)
        OST_TRY(ost_block_sum_number(product->sum, product->far->column[k], &product->far_column[k]));
    return OST_SUCCESS;
}

static OstStatus import_rows(Product *product, const OstGlobal *number)
{
    OstContext *ctx = product->ctx;
    OstHalo *halo = product->a->halo;
    const size_t bytes = (size_t)(product->p->height * WIDTH) * sizeof(float);
    OstBlockRows *out = NULL;
    OstStatus status = ost_block_rows_create(ctx, halo->send_start[halo->neighbour_count], bytes, &out);
    if (status == OST_SUCCESS)
        status = pack_rows(product, number, out);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_block_rows_exchange(halo, OST_TO_GHOSTS, out, &product->far));
    OST_TRY_DONE(ost_agree(ctx, number_far_columns(product)));
done:
    ost_block_rows_destroy(&out);
    return status;
}

/* row += a × the blocks of one row of P */
OST_UNROLLED void add_row(Product *product, int size, const double *a, OstLocal blocks, const OstLocal *column,
                          const float *value)
{
    for (OstLocal k = 0; k < blocks; k++, value += size * WIDTH) {
        OstLocal *place = product->place + column[k];
        if (*place < 0) {
            *place = product->count;
            product->column[product->count++] = column[k];
            memset(product->row + size * *place, 0, (size_t)size * sizeof *product->row);
        }
        ost_block_multiply(size, a, value, product->row + size * *place);
    }
}

/* Row i of A P. */
OST_UNROLLED void multiply_row(Product *product, int size, OstLocal i)
{
    const OstExactMatrix *a = product->a;
    const OstProlongator *p = product->p;
    const OstBlockRows *far = product->far;
    double room[9];
    product->count = 0;
    for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
        const double *value = ost_exact_matrix_block(a, size, i, k, room);
        const OstLocal j = a->column[k];
        if (j < a->rows) {
            const OstLocal from = p->row_start[j];
            add_row(product, size, value, p->row_start[j + 1] - from, p->column + from,
                    p->value + (size_t)(size * WIDTH) * (size_t)from);
        } else {
            const OstLocal from = far->start[j - a->rows];
            add_row(product, size, value, far->start[j - a->rows + 1] - from, product->far_column + from,
                    (const float *)(const void *)far->value + (size_t)(size * WIDTH) * (size_t)from);
        }
    }
    for (OstLocal m = 0; m < product->count; m++)
        product->place[product->column[m]] = -1;
}

/* Adds row i of Pᵀ, times row i of A P, to the product. */
OST_UNROLLED OstStatus add_products(Product *product, int size, OstLocal i)
{
    const OstProlongator *p = product->p;
    for (OstLocal k = p->row_start[i]; k < p->row_start[i + 1]; k++) {
        const float *value = p->value + (size_t)(size * WIDTH) * (size_t)k;
        double exact[BLOCK];
        for (int e = 0; e < size * WIDTH; e++)
            exact[e] = (double)value[e];
        for (OstLocal m = 0; m < product->count; m++) {
            OstDouble8 *block;
            if (ost_block_sum_is_mirrored(product->sum, p->column[k], product->column[m]))
                continue;
            OST_TRY(ost_block_sum_find(product->sum, p->column[k], product->column[m], &block));
            ost_block_multiply_transposed(size, exact, product->row + size * m, block);
        }
    }
    return OST_SUCCESS;
}

static OstStatus multiply(Product *product)
{
    const size_t columns = (size_t)product->sum->owned + (size_t)product->sum->ghost->count;
    OST_TRY(OST_NEW(product->ctx, &product->place, columns));
    OST_TRY(OST_NEW(product->ctx, &product->column, columns));
    OST_TRY(OST_NEW(product->ctx, &product->row, columns * (size_t)product->a->size));
    for (size_t c = 0; c < columns; c++)
        product->place[c] = -1;
    for (OstLocal i = 0; i < product->a->rows; i++)
        if (product->a->size == 3) {
            multiply_row(product, 3, i);
            OST_TRY(add_products(product, 3, i));
        } else {
            multiply_row(product, 6, i);
            OST_TRY(add_products(product, 6, i));
        }
    return OST_SUCCESS;
}

OstStatus ost_galerkin_create(const OstExactMatrix *matrix, const OstProlongator *prolongator, OstGlobal first_coarse,
                              OstExactMatrix **coarse)
{
    OstContext *ctx = matrix->ctx;
    Product product = {.ctx = ctx, .a = matrix, .p = prolongator};
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

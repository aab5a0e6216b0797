/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/level_columns.h"

#include "core/kernel.h"

#include <string.h>

/* --- ghosts, column by column --- */

static void take_column(const OstLightColumns *x, size_t from, size_t end, int k, double *one)
{
    for (size_t i = from; i < end; i++)
        one[i] = (double)x[i][k];
}

static void put_column(const double *one, size_t from, size_t end, int k, OstLightColumns *x)
{
    for (size_t i = from; i < end; i++)
        x[i][k] = (float)one[i];
}

/* Of vectors whose first `owned` numbers of `all` are this rank's. */
static void import(const OstExchange *exchange, size_t owned, size_t all, OstLightColumns *x, double *one)
{
    for (int k = 0; k < OST_COLUMNS && ost_exchange_any(exchange); k++) {
        take_column(x, 0, owned, k, one);
        ost_exchange_import(exchange, one);
        put_column(one, owned, all, k, x);
    }
}

static void add_to_owners(const OstExchange *exchange, size_t owned, size_t all, OstLightColumns *x, double *one)
{
    for (int k = 0; k < OST_COLUMNS && ost_exchange_any(exchange); k++) {
        take_column(x, 0, all, k, one);
        ost_exchange_add_to_owners(exchange, one);
        put_column(one, 0, owned, k, x);
    }
}

/* --- products --- */

/* Each block right of the diagonal acts on its row and, transposed, on the row of its column. */
OST_UNROLLED void add_rows(const OstLevelMatrix *matrix, int size, float scale, const OstLightColumns *restrict x,
                           OstLightColumns *restrict y)
{
    const size_t square = (size_t)(size * size), side = (size_t)size;
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const OstLightColumns *own = x + side * (size_t)i;
        const float *a = matrix->diagonal + square * (size_t)i;
        OstLightColumns sum[OST_MODES], scaled[OST_MODES];
        for (int r = 0; r < size; r++) {
            scaled[r] = scale * own[r];
            sum[r] = a[size * r] * own[0];
            for (int c = 1; c < size; c++)
                sum[r] += a[size * r + c] * own[c];
        }
        OstLocal k = matrix->row_start[i];
        a = matrix->value + square * (size_t)k;
        for (; k < matrix->own_end[i]; k++, a += square) {
            const OstLightColumns *v = x + side * (size_t)matrix->column[k];
            OstLightColumns *target = y + side * (size_t)matrix->column[k];
            for (int c = 0; c < size; c++) {
                const OstLightColumns there = v[c];
                OstLightColumns mirrored = target[c];
                for (int r = 0; r < size; r++) {
                    sum[r] += a[size * r + c] * there;
                    mirrored += a[size * r + c] * scaled[r];
                }
                target[c] = mirrored;
            }
        }
        for (; k < matrix->row_start[i + 1]; k++, a += square) {
            const OstLightColumns *v = x + side * (size_t)matrix->column[k];
            for (int c = 0; c < size; c++)
                for (int r = 0; r < size; r++)
                    sum[r] += a[size * r + c] * v[c];
        }
        for (int r = 0; r < size; r++)
            y[side * (size_t)i + (size_t)r] += scale * sum[r];
    }
}

OST_KERNEL static void add3(const OstLevelMatrix *matrix, float scale, const OstLightColumns *x, OstLightColumns *y)
{
    add_rows(matrix, 3, scale, x, y);
}

OST_KERNEL static void add6(const OstLevelMatrix *matrix, float scale, const OstLightColumns *x, OstLightColumns *y)
{
    add_rows(matrix, 6, scale, x, y);
}

void ost_level_matrix_add_columns(const OstLevelMatrix *matrix, float scale, OstLightColumns *x, OstLightColumns *y,
                                  double *one)
{
    const size_t size = (size_t)matrix->size;
    import(matrix->exchange, size * (size_t)matrix->rows, size * (size_t)matrix->columns, x, one);
    ost_ledger_multiplied(matrix->ctx, (double)matrix->nonzeros);
    if (size == 3)
        add3(matrix, scale, x, y);
    else
        add6(matrix, scale, x, y);
}

/* --- blocks --- */

enum { TILE = 12 }; /* rows of a block at a time: so many sums hide what one takes */

/* out = rows `from` on of value × in; the matrix is symmetric. */
OST_UNROLLED void multiply_tile(int rows, int side, const float *value, const OstLightColumns *in, OstLightColumns *out)
{
    OstLightColumns sum[TILE];
    for (int r = 0; r < rows; r++)
        sum[r] = value[r] * in[0];
    for (int j = 1; j < side; j++)
        for (int r = 0; r < rows; r++)
            sum[r] += value[j * side + r] * in[j];
    for (int r = 0; r < rows; r++)
        out[r] = sum[r];
}

OST_UNROLLED void multiply_block(int side, const float *value, const OstLightColumns *in, OstLightColumns *out)
{
    int row = 0;
    for (; row + TILE <= side; row += TILE)
        multiply_tile(TILE, side, value + row, in, out + row);
    for (; row + 6 <= side; row += 6)
        multiply_tile(6, side, value + row, in, out + row);
    for (; row < side; row += 3)
        multiply_tile(3, side, value + row, in, out + row);
}

OST_UNROLLED void apply_blocks(const OstSmootherBlocks *blocks, int size, const OstColumnStep *step,
                               const OstLightColumns *r)
{
    for (OstLocal b = 0; b < blocks->count; b++) {
        const OstLocal *node = blocks->node + blocks->node_start[b];
        const int nodes = blocks->node_start[b + 1] - blocks->node_start[b], side = size * nodes;
        OstLightColumns in[OST_LARGEST_SIDE], out[OST_LARGEST_SIDE];
        for (int n = 0; n < nodes; n++)
            for (int i = 0; i < size; i++)
                in[size * n + i] = r[(size_t)size * (size_t)node[n] + (size_t)i];
        multiply_block(side, blocks->value + blocks->value_start[b], in, out);
        for (int n = 0; n < nodes; n++)
            for (int i = 0; i < size; i++) {
                const size_t at = (size_t)size * (size_t)node[n] + (size_t)i;
                OstLightColumns direction = step->add * out[size * n + i];
                if (step->keep != 0.0F)
                    direction += step->keep * step->direction[at];
                step->direction[at] = direction;
                if (!step->is_first)
                    direction += step->sum[at];
                step->sum[at] = direction;
            }
    }
}

OST_KERNEL void ost_smoother_blocks_step_columns(const OstSmootherBlocks *blocks, const OstColumnStep *step,
                                                 const OstLightColumns *r)
{
    ost_ledger_multiplied(blocks->ctx, (double)blocks->value_start[blocks->count]);
    if (blocks->size == 3)
        apply_blocks(blocks, 3, step, r);
    else
        apply_blocks(blocks, 6, step, r);
}

/* --- prolongators --- */

OST_UNROLLED void apply_rows(const OstProlongator *p, int height, const OstLightColumns *restrict c,
                             OstColumns *restrict x)
{
    for (OstLocal i = 0; i < p->rows; i++) {
        OstLightColumns sum[OST_MODES] = {{0}};
        for (OstLocal k = p->row_start[i]; k < p->row_start[i + 1]; k++) {
            const float *a = p->value + (size_t)(height * OST_MODES) * (size_t)k;
            const OstLightColumns *v = c + OST_MODES * (size_t)p->column[k];
            for (int m = 0; m < OST_MODES; m++)
                for (int r = 0; r < height; r++)
                    sum[r] += a[OST_MODES * r + m] * v[m];
        }
        for (int r = 0; r < height; r++)
            x[(size_t)height * (size_t)i + (size_t)r] = __builtin_convertvector(sum[r], OstColumns);
    }
}

OST_UNROLLED void restrict_rows(const OstProlongator *p, int height, const OstColumns *restrict x,
                                OstLightColumns *restrict c)
{
    for (OstLocal i = 0; i < p->rows; i++) {
        OstLightColumns v[OST_MODES];
        for (int r = 0; r < height; r++)
            v[r] = __builtin_convertvector(x[(size_t)height * (size_t)i + (size_t)r], OstLightColumns);
        for (OstLocal k = p->row_start[i]; k < p->row_start[i + 1]; k++) {
            const float *a = p->value + (size_t)(height * OST_MODES) * (size_t)k;
            OstLightColumns *target = c + OST_MODES * (size_t)p->column[k];
            for (int m = 0; m < OST_MODES; m++) {
                OstLightColumns sum = target[m];
                for (int r = 0; r < height; r++)
                    sum += a[OST_MODES * r + m] * v[r];
                target[m] = sum;
            }
        }
    }
}

static void book(const OstProlongator *prolongator)
{
    const double entries = (double)prolongator->row_start[prolongator->rows];
    ost_ledger_multiplied(prolongator->ctx, entries * prolongator->height * OST_MODES);
}

OST_KERNEL void ost_prolongator_apply_columns(const OstProlongator *prolongator, OstLightColumns *c, OstColumns *x,
                                              double *one)
{
    const OstHalo *halo = prolongator->halo;
    import(prolongator->exchange, OST_MODES * (size_t)halo->owned, OST_MODES * (size_t)prolongator->columns, c, one);
    book(prolongator);
    if (prolongator->height == 3)
        apply_rows(prolongator, 3, c, x);
    else
        apply_rows(prolongator, 6, c, x);
}

OST_KERNEL void ost_prolongator_restrict_columns(const OstProlongator *prolongator, const OstColumns *x,
                                                 OstLightColumns *c, double *one)
{
    const size_t all = OST_MODES * (size_t)prolongator->columns;
    memset(c, 0, all * sizeof *c);
    if (prolongator->height == 3)
        restrict_rows(prolongator, 3, x, c);
    else
        restrict_rows(prolongator, 6, x, c);
    add_to_owners(prolongator->exchange, OST_MODES * (size_t)prolongator->halo->owned, all, c, one);
    book(prolongator);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/smoother_blocks.h"

#include "algebra/aggregation/aggregates.h"
#include "algebra/level/simd.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/small.h"

#include <string.h>

enum { MOST_STRIPS = 3 };

/* A block that holds a whole stiff inclusion, or nodes of nearly inextensible fibres, may be nearly singular, and its
 * inverse too large for single precision: so much of the diagonal is added to it. */
static const double softening = 1e-6;

void ost_smoother_blocks_destroy(OstSmootherBlocks **blocks)
{
    if (!*blocks)
        return;
    OST_FREE((*blocks)->node_start, (*blocks)->node, (*blocks)->value_start, (*blocks)->value);
    OST_FREE(*blocks);
}

/* Adds the block of node[] up to `end`. */
static void end_block(OstSmootherBlocks *blocks, OstLocal end)
{
    const OstLocal b = blocks->count++;
    const size_t side = (size_t)blocks->size * (size_t)(end - blocks->node_start[b]);
    blocks->node_start[b + 1] = end;
    blocks->value_start[b + 1] = blocks->value_start[b] + side * side;
}

/* One block per aggregate, and per node that is in none; those too large for a dense inverse are split. */
static OstStatus list_blocks(const OstAggregates *aggregates, OstLocal nodes, OstSmootherBlocks *blocks)
{
    OstContext *ctx = blocks->ctx;
    OstLocal *start = NULL;
    OstStatus status = OST_SUCCESS;
    size_t room = (size_t)aggregates->count + (size_t)nodes / OST_LARGEST_BLOCK + 1;
    for (OstLocal i = 0; i < nodes; i++)
        room += aggregates->of_node[i] < 0;
    OST_TRY_DONE(ost_aggregates_list(aggregates, nodes, &start, &blocks->node));
    OST_TRY_DONE(OST_NEW(ctx, &blocks->node_start, room));
    OST_TRY_DONE(OST_NEW(ctx, &blocks->value_start, room));
    for (OstLocal a = 0; a < aggregates->count; a++)
        for (OstLocal from = start[a]; from < start[a + 1]; from += OST_LARGEST_BLOCK)
            end_block(blocks, from + OST_LARGEST_BLOCK < start[a + 1] ? from + OST_LARGEST_BLOCK : start[a + 1]);
    for (OstLocal i = 0; i < nodes; i++)
        if (aggregates->of_node[i] < 0) {
            const OstLocal end = blocks->node_start[blocks->count];
            blocks->node[end] = i;
            end_block(blocks, end + 1);
        }
    OST_TRY_DONE(OST_NEW(ctx, &blocks->value, blocks->value_start[blocks->count] + OST_PADDING));
done:
    OST_FREE(start);
    return status;
}

/* Stores a 3 × 3 or 6 × 6 block and its transpose. */
static void spread(int size, const float *value, int side, double *lower, double *upper)
{
    for (int r = 0; r < size; r++)
        for (int c = 0; c < size; c++)
            lower[c * side + r] = upper[r * side + c] = (double)value[r * size + c];
}

/* The diagonal block b of the matrix as a dense one; of_node: each node's block; place: its place there. */
static void gather_block(const OstLevelMatrix *matrix, const OstSmootherBlocks *blocks, OstLocal b,
                         const OstLocal *of_node, const OstLocal *place, double *dense)
{
    const int size = blocks->size;
    const int side = size * (blocks->node_start[b + 1] - blocks->node_start[b]);
    const size_t square = (size_t)(size * size);
    memset(dense, 0, (size_t)side * (size_t)side * sizeof *dense);
    for (OstLocal m = blocks->node_start[b]; m < blocks->node_start[b + 1]; m++) {
        const OstLocal i = blocks->node[m];
        double *row = dense + place[i] * size * side, *column = dense + place[i] * size;
        spread(size, matrix->diagonal + square * (size_t)i, side, row + place[i] * size, row + place[i] * size);
        for (OstLocal k = matrix->row_start[i]; k < matrix->own_end[i]; k++) {
            const OstLocal j = matrix->column[k];
            if (of_node[j] == b)
                spread(size, matrix->value + square * (size_t)k, side, column + place[j] * size * side,
                       row + place[j] * size);
        }
    }
}

/* inverse = A^-1 by the Cholesky factor, which overwrites A; returns 0, or the number of the pivot that is not
 * positive.
 */
static int invert_dense(int side, double *a, double *inverse)
{
    const int pivot = ost_cholesky(side, a);
    if (pivot != 0)
        return pivot;
    for (int i = 0; i < side; i++) { /* L^-1, row by row, in the lower part */
        double *row = inverse + i * side;
        memset(row, 0, (size_t)side * sizeof *row);
        for (int k = 0; k < i; k++) {
            const double factor = a[i * side + k];
            for (int j = 0; j <= k; j++)
                row[j] -= factor * inverse[k * side + j];
        }
        row[i] = 1.0;
        for (int j = 0; j <= i; j++)
            row[j] /= a[i * side + i];
    }
    memset(a, 0, (size_t)(side * side) * sizeof *a);
    for (int k = 0; k < side; k++)
        for (int i = 0; i <= k; i++)
            for (int j = 0; j <= k; j++)
                a[i * side + j] += inverse[k * side + i] * inverse[k * side + j];
    memcpy(inverse, a, (size_t)(side * side) * sizeof *a);
    return 0;
}

/* Inverts the diagonal blocks of single nodes instead; where one is not positive definite, its diagonal. */
static void invert_nodes(int size, int side, const double *a, double *inverse)
{
    memset(inverse, 0, (size_t)(side * side) * sizeof *inverse);
    for (int n = 0; n < side; n += size) {
        double block[36], block_inverse[36];
        for (int r = 0; r < size; r++)
            for (int c = 0; c < size; c++)
                block[r * size + c] = a[(n + r) * side + n + c];
        const int failed = invert_dense(size, block, block_inverse);
        for (int r = 0; r < size; r++) {
            const double diagonal = a[(n + r) * side + n + r];
            if (failed)
                inverse[(n + r) * side + n + r] = diagonal > 0.0 ? 1.0 / diagonal : 1.0;
            for (int c = 0; c < size && !failed; c++)
                inverse[(n + r) * side + n + c] = block_inverse[r * size + c];
        }
    }
}

static void soften_dense(int side, double *dense)
{
    for (int i = 0; i < side; i++)
        dense[(side + 1) * i] *= 1.0 + softening;
}

static OstStatus fill_blocks(const OstLevelMatrix *matrix, OstSmootherBlocks *blocks)
{
    OstLocal *of_node = NULL;
    double *dense = NULL;
    OstStatus status;
    OST_TRY_DONE(OST_NEW(blocks->ctx, &of_node, 2 * (size_t)matrix->rows));
    OST_TRY_DONE(OST_NEW(blocks->ctx, &dense, 2 * OST_LARGEST_SIDE * OST_LARGEST_SIDE));
    OstLocal *place = of_node + matrix->rows;
    double *inverse = dense + OST_LARGEST_SIDE * OST_LARGEST_SIDE;
    for (OstLocal b = 0; b < blocks->count; b++)
        for (OstLocal k = blocks->node_start[b]; k < blocks->node_start[b + 1]; k++) {
            of_node[blocks->node[k]] = b;
            place[blocks->node[k]] = k - blocks->node_start[b];
        }
    for (OstLocal b = 0; b < blocks->count; b++) {
        const int side = blocks->size * (blocks->node_start[b + 1] - blocks->node_start[b]);
        gather_block(matrix, blocks, b, of_node, place, dense);
        soften_dense(side, dense);
        if (invert_dense(side, dense, inverse) != 0) {
            gather_block(matrix, blocks, b, of_node, place, dense);
            invert_nodes(blocks->size, side, dense, inverse);
        }
        float *value = blocks->value + blocks->value_start[b];
        for (int k = 0; k < side * side; k++)
            value[k] = (float)inverse[k];
    }
done:
    OST_FREE(of_node, dense);
    return status;
}

OstStatus ost_smoother_blocks_of(const OstLevelMatrix *matrix, const OstAggregates *groups, OstSmootherBlocks **blocks)
{
    OstStatus status;
    OST_TRY_DONE(OST_NEW(matrix->ctx, blocks, 1));
    (*blocks)->ctx = matrix->ctx;
    (*blocks)->size = matrix->size;
    OST_TRY_DONE(list_blocks(groups, matrix->rows, *blocks));
    OST_TRY_DONE(fill_blocks(matrix, *blocks));
done:
    if (status != OST_SUCCESS)
        ost_smoother_blocks_destroy(blocks);
    return status;
}

OstStatus ost_smoother_blocks_create(const OstLevelMatrix *matrix, const OstMetricGraph *graph, double target,
                                     OstSmootherBlocks **blocks)
{
    const OstAggregateShape shape = {.target = target, .minimum = 1, .recentrings = 0, .together = OST_LARGEST_BLOCK};
    OstAggregates *groups = NULL;
    *blocks = NULL;
    OstStatus status = ost_aggregates_create(graph, &shape, &groups);
    OST_THEN(ost_smoother_blocks_of(matrix, groups, blocks));
    ost_aggregates_destroy(&groups);
    return status;
}

/* out = value × in for `count` strips of eight rows that start at offset[]. Even and odd columns are summed apart, as
 * two independent sums hide the latency of the additions. */
OST_UNROLLED void multiply_strips(int count, int side, const float *value, const int *offset, const float *in,
                                  float *out)
{
    OstFloat8 even[MOST_STRIPS] = {{0}}, odd[MOST_STRIPS] = {{0}};
    int j = 0;
    for (; j + 1 < side; j += 2, value += 2 * side)
        for (int s = 0; s < count; s++) {
            even[s] += in[j] * *(const OstFloat8 *)(value + offset[s]);
            odd[s] += in[j + 1] * *(const OstFloat8 *)(value + side + offset[s]);
        }
    for (int s = 0; s < count && j < side; s++)
        even[s] += in[j] * *(const OstFloat8 *)(value + offset[s]);
    for (int s = 0; s < count; s++)
        *(OstFloat8 *)(out + offset[s]) = even[s] + odd[s];
}

/* out = value × in, in strips of eight rows of which the last two may overlap. With fewer than eight rows, out is
 * overwritten up to out[7]. */
OST_UNROLLED void multiply_dense(int side, const float *value, const float *in, float *out)
{
    for (int from = 0; from < side; from += 8 * MOST_STRIPS) {
        int count = 0, offset[MOST_STRIPS];
        for (int row = from; row < side && count < MOST_STRIPS; row += 8)
            offset[count++] = row + 8 <= side ? row : side > 8 ? side - 8 : 0;
        if (count == 3)
            multiply_strips(3, side, value, offset, in, out);
        else if (count == 2)
            multiply_strips(2, side, value, offset, in, out);
        else
            multiply_strips(1, side, value, offset, in, out);
    }
}

OST_UNROLLED void apply_blocks(const OstSmootherBlocks *blocks, int size, int from_zero, const OstBlockStep *step,
                               const double *r)
{
    for (OstLocal b = 0; b < blocks->count; b++) {
        const OstLocal *node = blocks->node + blocks->node_start[b];
        const int nodes = blocks->node_start[b + 1] - blocks->node_start[b];
        float in[OST_LARGEST_SIDE + OST_PADDING], out[OST_LARGEST_SIDE + OST_PADDING];
        for (int k = 0; k < nodes; k++)
            for (int c = 0; c < size; c++)
                in[k * size + c] = (float)r[(size_t)size * (size_t)node[k] + (size_t)c];
        multiply_dense(size * nodes, blocks->value + blocks->value_start[b], in, out);
        for (int k = 0; k < nodes; k++) {
            double *restrict direction = step->direction + (size_t)size * (size_t)node[k];
            double *restrict x = step->x + (size_t)size * (size_t)node[k];
            for (int c = 0; c < size; c++) {
                const double added = step->add * (double)out[k * size + c];
                direction[c] = from_zero ? added : step->keep * direction[c] + added;
                x[c] = from_zero ? direction[c] : x[c] + direction[c];
            }
        }
    }
}

OST_KERNEL void ost_smoother_blocks_step(const OstSmootherBlocks *blocks, const OstBlockStep *step, const double *r)
{
    ost_ledger_multiplied(blocks->ctx, (double)blocks->value_start[blocks->count]);
    if (blocks->size == 3 && step->from_zero)
        apply_blocks(blocks, 3, 1, step, r);
    else if (blocks->size == 3)
        apply_blocks(blocks, 3, 0, step, r);
    else if (step->from_zero)
        apply_blocks(blocks, 6, 1, step, r);
    else
        apply_blocks(blocks, 6, 0, step, r);
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_blocks.h"

#include "algebra/metric_aggregate.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"

#include <string.h>

enum { LARGEST_BLOCK = 24, LARGEST_SIDE = 6 * LARGEST_BLOCK };

void ost_metric_blocks_destroy(OstMetricBlocks **blocks)
{
    if (!*blocks)
        return;
    OST_FREE((*blocks)->node_start);
    OST_FREE((*blocks)->node);
    OST_FREE((*blocks)->value_start);
    OST_FREE((*blocks)->value);
    OST_FREE(*blocks);
}

/* Sorts the nodes by aggregate; start has aggregates + 1 entries. */
static void sort_nodes(const OstAggregates *aggregates, OstLocal nodes, OstLocal *start, OstLocal *node)
{
    for (OstLocal i = 0; i < nodes; i++)
        start[aggregates->of_node[i] + 1]++;
    for (OstLocal a = 0; a < aggregates->count; a++)
        start[a + 1] += start[a];
    for (OstLocal i = nodes - 1; i >= 0; i--)
        node[--start[aggregates->of_node[i] + 1]] = i;
    for (OstLocal a = 0; a < aggregates->count; a++)
        start[a] = start[a + 1];
    start[aggregates->count] = nodes;
}

/* One block per aggregate; those too large for a dense inverse are cut. */
static OstStatus list_blocks(const OstAggregates *aggregates, OstLocal nodes, OstMetricBlocks *blocks)
{
    OstContext *ctx = blocks->ctx;
    OstLocal *start = NULL;
    OstStatus status = OST_SUCCESS;
    const size_t room = (size_t)aggregates->count + (size_t)nodes / LARGEST_BLOCK + 1;
    OST_TRY_DONE(OST_NEW(ctx, &start, aggregates->count + 1));
    OST_TRY_DONE(OST_NEW(ctx, &blocks->node, nodes));
    OST_TRY_DONE(OST_NEW(ctx, &blocks->node_start, room));
    OST_TRY_DONE(OST_NEW(ctx, &blocks->value_start, room));
    sort_nodes(aggregates, nodes, start, blocks->node);
    for (OstLocal a = 0; a < aggregates->count; a++)
        for (OstLocal from = start[a]; from < start[a + 1]; from += LARGEST_BLOCK) {
            const OstLocal end = from + LARGEST_BLOCK < start[a + 1] ? from + LARGEST_BLOCK : start[a + 1];
            const size_t side = (size_t)blocks->size * (size_t)(end - from);
            const OstLocal b = blocks->count++;
            blocks->node_start[b + 1] = end;
            blocks->value_start[b + 1] = blocks->value_start[b] + side * side;
        }
    OST_TRY_DONE(OST_NEW(ctx, &blocks->value, blocks->value_start[blocks->count]));
done:
    OST_FREE(start);
    return status;
}

/* The block's part of the matrix, dense; `place` is each node's place in its block and `of_node` its block. */
static void gather_block(const OstMetricOperator *matrix, const OstMetricBlocks *blocks, OstLocal b,
                         const OstLocal *of_node, const OstLocal *place, double *dense)
{
    const int size = blocks->size;
    const int side = size * (blocks->node_start[b + 1] - blocks->node_start[b]);
    memset(dense, 0, (size_t)side * (size_t)side * sizeof *dense);
    for (OstLocal k = blocks->node_start[b]; k < blocks->node_start[b + 1]; k++) {
        const OstLocal i = blocks->node[k];
        for (OstLocal e = matrix->row_start[i]; e < matrix->row_start[i + 1]; e++) {
            const OstLocal j = matrix->column[e];
            if (j >= matrix->rows || of_node[j] != b)
                continue;
            const float *value = matrix->value + (size_t)(size * size) * (size_t)e;
            for (int c = 0; c < size; c++)
                for (int r = 0; r < size; r++)
                    dense[(place[i] * size + r) * side + place[j] * size + c] = (double)value[c * size + r];
        }
    }
}

/* inverse = A^-1 by way of the Cholesky factor, which replaces A; returns 0, or the pivot that is not positive. */
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

/* Inverts only the `size` × `size` blocks on the diagonal of `a`, or of those that fail only their diagonals. */
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

static void invert_blocks(const OstMetricOperator *matrix, const OstLocal *of_node, const OstLocal *place,
                          double *dense, double *inverse, OstMetricBlocks *blocks)
{
    for (OstLocal b = 0; b < blocks->count; b++) {
        const int side = blocks->size * (blocks->node_start[b + 1] - blocks->node_start[b]);
        gather_block(matrix, blocks, b, of_node, place, dense);
        if (invert_dense(side, dense, inverse) != 0) {
            gather_block(matrix, blocks, b, of_node, place, dense);
            invert_nodes(blocks->size, side, dense, inverse);
        }
        float *value = blocks->value + blocks->value_start[b];
        for (int k = 0; k < side * side; k++)
            value[k] = (float)inverse[k];
    }
}

static OstStatus fill_blocks(const OstMetricOperator *matrix, OstMetricBlocks *blocks)
{
    OstContext *ctx = blocks->ctx;
    OstLocal *of_node = NULL, *place = NULL;
    double *dense = NULL, *inverse = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &of_node, matrix->rows));
    OST_TRY_DONE(OST_NEW(ctx, &place, matrix->rows));
    OST_TRY_DONE(OST_NEW(ctx, &dense, LARGEST_SIDE * LARGEST_SIDE));
    OST_TRY_DONE(OST_NEW(ctx, &inverse, LARGEST_SIDE * LARGEST_SIDE));
    for (OstLocal b = 0; b < blocks->count; b++)
        for (OstLocal k = blocks->node_start[b]; k < blocks->node_start[b + 1]; k++) {
            of_node[blocks->node[k]] = b;
            place[blocks->node[k]] = k - blocks->node_start[b];
        }
    invert_blocks(matrix, of_node, place, dense, inverse, blocks);
done:
    OST_FREE(of_node);
    OST_FREE(place);
    OST_FREE(dense);
    OST_FREE(inverse);
    return status;
}

OstStatus ost_metric_blocks_create(const OstMetricOperator *matrix, const OstMetricGraph *graph, double target,
                                   OstMetricBlocks **blocks)
{
    const OstAggregateShape shape = {.target = target, .minimum = 1, .recentrings = 1};
    OstAggregates *aggregates = NULL;
    *blocks = NULL;
    OstStatus status = ost_aggregates_create(graph, &shape, &aggregates);
    if (status != OST_SUCCESS)
        return status;
    OST_TRY_DONE(OST_NEW(matrix->ctx, blocks, 1));
    (*blocks)->ctx = matrix->ctx;
    (*blocks)->size = matrix->height;
    OST_TRY_DONE(list_blocks(aggregates, matrix->rows, *blocks));
    OST_TRY_DONE(fill_blocks(matrix, *blocks));
done:
    ost_aggregates_destroy(&aggregates);
    if (status != OST_SUCCESS)
        ost_metric_blocks_destroy(blocks);
    return status;
}

void ost_metric_blocks_apply(const OstMetricBlocks *blocks, const double *r, double *z)
{
    const int size = blocks->size;
    for (OstLocal b = 0; b < blocks->count; b++) {
        const OstLocal *node = blocks->node + blocks->node_start[b];
        const int nodes = blocks->node_start[b + 1] - blocks->node_start[b];
        const int side = size * nodes;
        const float *value = blocks->value + blocks->value_start[b];
        float in[LARGEST_SIDE], out[LARGEST_SIDE] = {0};
        for (int k = 0; k < nodes; k++)
            for (int c = 0; c < size; c++)
                in[k * size + c] = (float)r[size * node[k] + c];
        for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++)
                out[i] += value[j * side + i] * in[j];
        for (int k = 0; k < nodes; k++)
            for (int c = 0; c < size; c++)
                z[size * node[k] + c] = (double)out[k * size + c];
    }
}

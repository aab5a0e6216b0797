/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/prolongator_smoothing.h"

#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/number_set.h"

#include <string.h>

static const double damping = 4.0 / 3.0;

typedef struct Smoothing {
    const OstDoubleMatrix *matrix;
    const OstTentative *tentative;
    const OstSmootherBlocks *blocks;
    OstProlongator *p;
    double omega;
    OstLocal *column;                     /* fine columns: the coarse column of each node, or -1 */
    OstLocal *block_start, *block_column; /* of each block: the coarse columns of its rows, ascending */
    OstLocal *place;                      /* coarse columns: the place of each in the current block, or -1 */
    OstRow6 *sum;                         /* the block's rows of A T, node by node, column by column */
} Smoothing;

static void destroy_smoothing(Smoothing *s)
{
    OST_FREE(s->column, s->block_start, s->block_column, s->place, s->sum);
}

/* Lists the coarse nodes of the fine ghosts, each once, and numbers the coarse column of every fine node. */
static OstStatus number_columns(Smoothing *s, OstGlobal **ghost)
{
    const OstDoubleMatrix *a = s->matrix;
    const OstTentative *t = s->tentative;
    OstLocal ghosts = 0;
    OST_TRY(OST_NEW(a->ctx, ghost, a->columns - a->rows));
    OST_TRY(OST_NEW(a->ctx, &s->column, a->columns));
    for (OstLocal j = a->rows; j < a->columns; j++)
        if (t->coarse[j] >= 0)
            (*ghost)[ghosts++] = t->coarse[j];
    ghosts = ost_numbers_sort(ghosts, *ghost);
    for (OstLocal j = 0; j < a->columns; j++)
        if (t->coarse[j] < 0)
            s->column[j] = -1;
        else if (j < a->rows)
            s->column[j] = (OstLocal)(t->coarse[j] - t->first_coarse);
        else
            s->column[j] = t->coarse_nodes + ost_numbers_find(ghosts, *ghost, t->coarse[j]);
    s->p->columns = t->coarse_nodes + ghosts;
    return OST_SUCCESS;
}

/* Lists the columns of a block's rows, ascending. B^-1 couples its rows, so all have the same columns. */
static void list_block(Smoothing *s, OstLocal b)
{
    const OstDoubleMatrix *a = s->matrix;
    const OstLocal start = s->block_start[b];
    OstLocal end = start;
    for (OstLocal m = s->blocks->node_start[b]; m < s->blocks->node_start[b + 1]; m++) {
        const OstLocal i = s->blocks->node[m];
        for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
            const OstLocal column = s->column[a->column[k]];
            if (column < 0 || s->place[column] == b)
                continue;
            OstLocal to = end++;
            s->place[column] = b; /* seen */
            for (; to > start && s->block_column[to - 1] > column; to--)
                s->block_column[to] = s->block_column[to - 1];
            s->block_column[to] = column;
        }
    }
    s->block_start[b + 1] = end;
}

static OstStatus list_blocks(Smoothing *s)
{
    const OstDoubleMatrix *a = s->matrix;
    OST_TRY(OST_NEW(a->ctx, &s->block_start, s->blocks->count + 1));
    OST_TRY(OST_NEW(a->ctx, &s->block_column, a->row_start[a->rows]));
    OST_TRY(OST_NEW(a->ctx, &s->place, s->p->columns));
    for (OstLocal c = 0; c < s->p->columns; c++)
        s->place[c] = -1;
    for (OstLocal b = 0; b < s->blocks->count; b++)
        list_block(s, b);
    for (OstLocal c = 0; c < s->p->columns; c++)
        s->place[c] = -1;
    return OST_RESIZE(a->ctx, &s->block_column, s->block_start[s->blocks->count]);
}

static OstStatus list_rows(Smoothing *s)
{
    OstContext *ctx = s->matrix->ctx;
    OstProlongator *p = s->p;
    OST_TRY(OST_NEW(ctx, &p->row_start, p->rows + 1));
    for (OstLocal b = 0; b < s->blocks->count; b++)
        for (OstLocal m = s->blocks->node_start[b]; m < s->blocks->node_start[b + 1]; m++)
            p->row_start[s->blocks->node[m] + 1] = s->block_start[b + 1] - s->block_start[b];
    for (OstLocal i = 0; i < p->rows; i++)
        p->row_start[i + 1] += p->row_start[i];
    OST_TRY(OST_NEW(ctx, &p->column, p->row_start[p->rows]));
    for (OstLocal b = 0; b < s->blocks->count; b++)
        for (OstLocal m = s->blocks->node_start[b]; m < s->blocks->node_start[b + 1]; m++)
            memcpy(p->column + p->row_start[s->blocks->node[m]], s->block_column + s->block_start[b],
                   (size_t)(s->block_start[b + 1] - s->block_start[b]) * sizeof *p->column);
    return OST_SUCCESS;
}

/* The block's rows of A T. */
OST_UNROLLED void sum_block(Smoothing *s, int size, OstLocal b)
{
    const OstDoubleMatrix *a = s->matrix;
    const size_t block = (size_t)(size * OST_MODES);
    const OstLocal start = s->block_start[b], count = s->block_start[b + 1] - start;
    const OstLocal first = s->blocks->node_start[b], nodes = s->blocks->node_start[b + 1] - first;
    double room[OST_BLOCK];
    memset(s->sum, 0, (size_t)nodes * (size_t)size * (size_t)count * sizeof *s->sum);
    for (OstLocal c = 0; c < count; c++)
        s->place[s->block_column[start + c]] = c;
    for (OstLocal m = 0; m < nodes; m++) {
        const OstLocal i = s->blocks->node[first + m];
        OstRow6 *row = s->sum + (size_t)m * (size_t)count * (size_t)size;
        for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
            const OstLocal column = s->column[a->column[k]];
            if (column >= 0)
                ost_block_multiply(size, ost_double_matrix_block(a, size, i, k, room),
                                   s->tentative->block + block * (size_t)a->column[k],
                                   row + (size_t)size * (size_t)s->place[column]);
        }
    }
}

/* The block's rows of T - omega B^-1 A T. */
OST_UNROLLED void smooth_block(Smoothing *s, int size, OstLocal b)
{
    const OstSmootherBlocks *blocks = s->blocks;
    OstProlongator *p = s->p;
    const OstLocal start = s->block_start[b], count = s->block_start[b + 1] - start;
    const OstLocal first = blocks->node_start[b], nodes = blocks->node_start[b + 1] - first;
    const float *inverse = blocks->value + blocks->value_start[b];
    const int side = size * nodes;
    sum_block(s, size, b);
    for (int row = 0; row < side; row++) {
        const OstLocal i = blocks->node[first + row / size];
        const int r = row % size;
        float *value = p->value + (size_t)(size * OST_MODES) * (size_t)p->row_start[i] + (size_t)(OST_MODES * r);
        const float *tentative = s->tentative->block + (size_t)(size * OST_MODES) * (size_t)i + OST_MODES * r;
        for (OstLocal c = 0; c < count; c++, value += size * OST_MODES) {
            OstRow6 total = {{0}, {0}};
            for (int k = 0; k < side; k++)
                ost_add_scaled_row6(
                    (double)inverse[row * side + k],
                    &s->sum[((size_t)(k / size) * (size_t)count + (size_t)c) * (size_t)size + (size_t)(k % size)],
                    &total);
            const int own = s->block_column[start + c] == s->column[i];
            double smoothed[OST_MODES] = {0};
            ost_add_row6(&total, smoothed);
            for (int mode = 0; mode < OST_MODES; mode++)
                value[mode] = (float)((own ? (double)tentative[mode] : 0.0) - s->omega * smoothed[mode]);
        }
    }
}

OST_KERNEL static OstStatus smooth_blocks(Smoothing *s)
{
    OstContext *ctx = s->matrix->ctx;
    const int size = s->matrix->size;
    OstProlongator *p = s->p;
    size_t largest = 0;
    for (OstLocal b = 0; b < s->blocks->count; b++) {
        const size_t blocks = (size_t)(s->block_start[b + 1] - s->block_start[b]) *
                              (size_t)(s->blocks->node_start[b + 1] - s->blocks->node_start[b]);
        largest = blocks > largest ? blocks : largest;
    }
    OST_TRY(OST_NEW(ctx, &s->sum, largest * (size_t)size));
    OST_TRY(OST_NEW(ctx, &p->value, (size_t)p->row_start[p->rows] * (size_t)(size * OST_MODES) + OST_PADDING));
    for (OstLocal b = 0; b < s->blocks->count; b++)
        if (size == 3)
            smooth_block(s, 3, b);
        else
            smooth_block(s, 6, b);
    return OST_SUCCESS;
}

static OstStatus prepare(Smoothing *s, OstGlobal **ghost)
{
    const OstDoubleMatrix *a = s->matrix;
    OST_TRY(OST_NEW(a->ctx, &s->p, 1));
    s->p->ctx = a->ctx;
    s->p->height = a->size;
    s->p->rows = a->rows;
    OST_TRY(number_columns(s, ghost));
    OST_TRY(list_blocks(s));
    return list_rows(s);
}

OstStatus ost_tentative_smooth(const OstTentative *tentative, const OstDoubleMatrix *matrix,
                               const OstSmoother *smoother, OstProlongator **prolongator)
{
    OstContext *ctx = matrix->ctx;
    Smoothing s = {
        .matrix = matrix, .tentative = tentative, .blocks = smoother->blocks, .omega = damping / smoother->largest};
    OstGlobal *ghost = NULL;
    *prolongator = NULL;
    OstStatus status = ost_agree(ctx, prepare(&s, &ghost));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_halo_create(ctx, tentative->coarse_nodes, tentative->first_coarse,
                                 s.p->columns - tentative->coarse_nodes, ghost, &s.p->halo));
    OST_TRY_DONE(ost_exchange_create(s.p->halo, OST_MODES, &s.p->exchange));
    OST_TRY_DONE(ost_agree(ctx, smooth_blocks(&s)));
done:
    OST_FREE(ghost);
    destroy_smoothing(&s);
    if (status != OST_SUCCESS)
        ost_prolongator_destroy(&s.p);
    *prolongator = s.p;
    return status;
}

static OstStatus copy_rows(const OstTentative *t, const OstDoubleMatrix *matrix, OstProlongator *p)
{
    const size_t block = (size_t)(matrix->size * OST_MODES);
    p->ctx = matrix->ctx;
    p->height = matrix->size;
    p->rows = matrix->rows;
    p->columns = t->coarse_nodes;
    OST_TRY(OST_NEW(p->ctx, &p->row_start, p->rows + 1));
    OST_TRY(OST_NEW(p->ctx, &p->column, p->rows));
    OST_TRY(OST_NEW(p->ctx, &p->value, block * (size_t)p->rows + OST_PADDING));
    if (t->rest)
        OST_TRY(OST_NEW(p->ctx, &p->rest, block * (size_t)p->rows + OST_PADDING));
    for (OstLocal i = 0; i < p->rows; i++) {
        OstLocal *end = &p->row_start[i + 1];
        *end = p->row_start[i];
        if (t->coarse[i] < 0)
            continue;
        p->column[*end] = (OstLocal)(t->coarse[i] - t->first_coarse);
        memcpy(p->value + block * (size_t)*end, t->block + block * (size_t)i, block * sizeof *p->value);
        if (t->rest)
            memcpy(p->rest + block * (size_t)*end, t->rest + block * (size_t)i, block * sizeof *p->rest);
        ++*end;
    }
    return OST_SUCCESS;
}

OstStatus ost_tentative_keep(const OstTentative *tentative, const OstDoubleMatrix *matrix, OstProlongator **prolongator)
{
    OstContext *ctx = matrix->ctx;
    OstProlongator *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    OST_THEN(copy_rows(tentative, matrix, made));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_halo_create(ctx, tentative->coarse_nodes, tentative->first_coarse, 0, NULL, &made->halo));
    OST_TRY_DONE(ost_exchange_create(made->halo, OST_MODES, &made->exchange));
done:
    if (status != OST_SUCCESS)
        ost_prolongator_destroy(&made);
    *prolongator = made;
    return status;
}

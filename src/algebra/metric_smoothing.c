/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_smoothing.h"

#include "algebra/metric_index.h"
#include "algebra/metric_spectrum.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static const double damping = 4.0 / 3.0;

/* What the rows are made from. */
typedef struct Smoothing {
    const OstExactMatrix *matrix;
    const OstTentative *tentative;
    OstProlongator *p;
    double omega;
    double *inverse;  /* rows × size: 1 over the diagonal */
    OstLocal *column; /* fine columns: the coarse column of each node, or -1 */
    OstLocal *place;  /* coarse columns: where its block is in the row at hand, if >= the row's start */
    OstDouble8 *sum;  /* the row's blocks */
} Smoothing;

static void destroy_smoothing(Smoothing *s)
{
    OST_FREE(s->inverse);
    OST_FREE(s->column);
    OST_FREE(s->place);
    OST_FREE(s->sum);
}

/* The coarse nodes of the fine ghosts, each once, and every fine node's coarse column. */
static OstStatus number_columns(Smoothing *s, OstGlobal **ghost)
{
    const OstExactMatrix *a = s->matrix;
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

/* The columns of each row, ascending. */
static void list_row(Smoothing *s, OstLocal i)
{
    const OstExactMatrix *a = s->matrix;
    OstProlongator *p = s->p;
    const OstLocal start = p->row_start[i];
    OstLocal end = start;
    for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
        const OstLocal column = s->column[a->column[k]];
        if (column < 0 || s->place[column] >= start)
            continue;
        OstLocal to = end++;
        s->place[column] = start; /* seen; put right below */
        for (; to > start && p->column[to - 1] > column; to--)
            p->column[to] = p->column[to - 1];
        p->column[to] = column;
    }
    p->row_start[i + 1] = end;
}

static OstStatus list_rows(Smoothing *s)
{
    const OstExactMatrix *a = s->matrix;
    OstProlongator *p = s->p;
    OST_TRY(OST_NEW(a->ctx, &p->row_start, a->rows + 1));
    OST_TRY(OST_NEW(a->ctx, &p->column, a->row_start[a->rows]));
    OST_TRY(OST_NEW(a->ctx, &s->place, p->columns));
    for (OstLocal c = 0; c < p->columns; c++)
        s->place[c] = -1;
    for (OstLocal i = 0; i < a->rows; i++)
        list_row(s, i);
    return OST_RESIZE(a->ctx, &p->column, p->row_start[a->rows]);
}

/* Row i of T - omega D^-1 A T. */
OST_UNROLLED void smooth_row(Smoothing *s, int size, OstLocal i)
{
    const OstExactMatrix *a = s->matrix;
    const size_t square = (size_t)(size * size), block = (size_t)(size * OST_MODES);
    OstProlongator *p = s->p;
    const OstLocal start = p->row_start[i], count = p->row_start[i + 1] - start;
    const float *tentative = s->tentative->block;
    memset(s->sum, 0, (size_t)count * (size_t)size * sizeof *s->sum);
    for (OstLocal m = 0; m < count; m++)
        s->place[p->column[start + m]] = m;
    for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
        const OstLocal column = s->column[a->column[k]];
        if (column >= 0)
            ost_block_multiply(size, a->value + square * (size_t)k, tentative + block * (size_t)a->column[k],
                               s->sum + (size_t)size * (size_t)s->place[column]);
    }
    for (OstLocal m = 0; m < count; m++) {
        float *value = p->value + block * (size_t)(start + m);
        const int own = p->column[start + m] == s->column[i];
        for (int r = 0; r < size; r++) {
            const double factor = -s->omega * s->inverse[(size_t)size * (size_t)i + (size_t)r];
            for (int c = 0; c < OST_MODES; c++) {
                const double t = own ? (double)tentative[block * (size_t)i + (size_t)(OST_MODES * r + c)] : 0.0;
                value[OST_MODES * r + c] = (float)(t + factor * s->sum[(size_t)m * (size_t)size + (size_t)r][c]);
            }
        }
    }
}

static OstStatus smooth_rows(Smoothing *s)
{
    OstContext *ctx = s->matrix->ctx;
    const int size = s->matrix->size;
    OstProlongator *p = s->p;
    OstLocal longest = 0;
    for (OstLocal i = 0; i < p->rows; i++)
        longest = p->row_start[i + 1] - p->row_start[i] > longest ? p->row_start[i + 1] - p->row_start[i] : longest;
    OST_TRY(OST_NEW(ctx, &s->sum, (size_t)longest * (size_t)size));
    OST_TRY(OST_NEW(ctx, &p->value, (size_t)p->row_start[p->rows] * (size_t)(size * OST_MODES) + OST_PADDING));
    for (OstLocal i = 0; i < p->rows; i++)
        if (size == 3)
            smooth_row(s, 3, i);
        else
            smooth_row(s, 6, i);
    return OST_SUCCESS;
}

static OstStatus invert_diagonal(Smoothing *s)
{
    const OstExactMatrix *a = s->matrix;
    const size_t size = (size_t)a->size;
    OST_TRY(OST_NEW(a->ctx, &s->inverse, size * (size_t)a->rows));
    for (OstLocal i = 0; i < a->rows; i++) {
        const double *block = ost_exact_matrix_diagonal(a, i);
        for (size_t r = 0; r < size; r++)
            s->inverse[size * (size_t)i + r] = 1.0 / block[(size + 1) * r];
    }
    return OST_SUCCESS;
}

static void divide_by_diagonal(const void *data, const double *r, double *z)
{
    const Smoothing *s = data;
    const size_t n = (size_t)s->matrix->size * (size_t)s->matrix->rows;
    for (size_t i = 0; i < n; i++)
        z[i] = s->inverse[i] * r[i];
}

static OstStatus choose_damping(Smoothing *s, const OstLevelMatrix *rounded)
{
    double largest;
    OST_TRY(ost_largest_eigenvalue(rounded, divide_by_diagonal, s, &largest));
    s->omega = damping / largest;
    return OST_SUCCESS;
}

static OstStatus prepare(Smoothing *s, OstGlobal **ghost)
{
    const OstExactMatrix *a = s->matrix;
    OST_TRY(OST_NEW(a->ctx, &s->p, 1));
    s->p->ctx = a->ctx;
    s->p->height = a->size;
    s->p->rows = a->rows;
    OST_TRY(number_columns(s, ghost));
    OST_TRY(list_rows(s));
    return invert_diagonal(s);
}

OstStatus ost_tentative_smooth(const OstTentative *tentative, const OstExactMatrix *matrix,
                               const OstLevelMatrix *rounded, OstProlongator **prolongator)
{
    OstContext *ctx = matrix->ctx;
    Smoothing s = {.matrix = matrix, .tentative = tentative};
    OstGlobal *ghost = NULL;
    *prolongator = NULL;
    OstStatus status = ost_agree(ctx, prepare(&s, &ghost));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_halo_create(ctx, tentative->coarse_nodes, tentative->first_coarse,
                                 s.p->columns - tentative->coarse_nodes, ghost, &s.p->halo));
    OST_TRY_DONE(choose_damping(&s, rounded));
    OST_TRY_DONE(ost_agree(ctx, smooth_rows(&s)));
done:
    OST_FREE(ghost);
    destroy_smoothing(&s);
    if (status != OST_SUCCESS)
        ost_prolongator_destroy(&s.p);
    *prolongator = s.p;
    return status;
}

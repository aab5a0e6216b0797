/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/cycle_columns.h"

#include "algebra/level/level_columns.h"
#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <string.h>

/* A level's vectors, of OST_COLUMNS columns each. */
typedef struct Level {
    const OstCycleLevel *of;
    const OstCycleLevel *next; /* the next coarser; NULL: there is none */
    OstLightColumns *x, *y;    /* over the columns and the rows of its matrix */
    OstLightColumns *sum;      /* of a sweep's steps, over the rows */
    OstLightColumns *coarse;   /* over the columns of its prolongator */
    OstColumns *of_linear;     /* over the columns of the linear tets; or NULL */
    double *one;               /* OST_COLUMNS vectors of the coarsest level, twice */
} Level;

struct OstCycleColumns {
    int count;
    Level level[OST_MAX_LEVELS + 1];
    OstMlCycle *ml;
    double *r, *z; /* of the finest level */
};

int ost_cycle_columns_fit(const OstCycle *cycle)
{
    for (int l = 0; l < cycle->count; l++)
        if (cycle->level[l].matrix->value_rest || (cycle->level[l].smoother && cycle->level[l].smoother->patches))
            return 0;
    return cycle->ml != NULL;
}

void ost_cycle_columns_destroy(OstCycleColumns **columns)
{
    if (!*columns)
        return;
    ost_ml_cycle_destroy(&(*columns)->ml);
    for (int l = 0; l < (*columns)->count; l++) {
        OST_FREE((*columns)->level[l].x, (*columns)->level[l].coarse, (*columns)->level[l].of_linear,
                 (*columns)->level[l].one);
    }
    OST_FREE((*columns)->r);
    OST_FREE(*columns);
}

static OstContext *enter(const Level *level)
{
    OstContext *ctx = level->of->matrix->ctx;
    ost_ledger_level(ctx, level->of->number);
    return ctx;
}

static OstStatus leave(const Level *level, OstStatus status)
{
    ost_ledger_level(level->of->matrix->ctx, -1);
    return status;
}

static void lighten(size_t n, const double *x, OstLightColumns *light)
{
    for (size_t i = 0; i < n; i++)
        light[i] = __builtin_convertvector(((const OstColumns *)x)[i], OstLightColumns);
}

/* y = A x */
static OstStatus multiply(void *data, const double *x, double *y)
{
    const Level *level = data;
    const OstLevelMatrix *matrix = level->of->matrix;
    const size_t n = ost_level_unknowns(matrix);
    enter(level);
    lighten(n, x, level->x);
    memset(level->y, 0, n * sizeof *level->y);
    ost_level_matrix_add_columns(matrix, 1.0F, level->x, level->y, level->of->own);
    for (size_t i = 0; i < n; i++)
        ((OstColumns *)y)[i] = __builtin_convertvector(level->y[i], OstColumns);
    return leave(level, OST_SUCCESS);
}

static void add_sum(size_t n, const OstLightColumns *sum, int from_zero, OstColumns *x)
{
    for (size_t i = 0; i < n && from_zero; i++)
        x[i] = __builtin_convertvector(sum[i], OstColumns);
    for (size_t i = 0; i < n && !from_zero; i++)
        x[i] += __builtin_convertvector(sum[i], OstColumns);
}

/* Chebyshev iteration, as ost_smoother_apply. */
static void sweep(const Level *level, const double *b, double *x, int from_zero)
{
    const OstSmoother *smoother = level->of->smoother;
    const OstLevelMatrix *matrix = smoother->matrix;
    OstChebyshev steps = ost_smoother_begin(smoother);
    OstColumnStep step = {.add = (float)steps.add, .direction = level->x, .sum = level->sum, .is_first = 1};
    const size_t n = ost_level_unknowns(matrix);
    lighten(n, b, level->y);
    if (!from_zero) {
        lighten(n, x, level->x);
        ost_level_matrix_add_columns(matrix, -1.0F, level->x, level->y, level->of->own);
    }
    ost_smoother_blocks_step_columns(smoother->blocks, &step, level->y);
    step.is_first = 0;
    for (int k = 1; k < smoother->degree; k++) {
        ost_level_matrix_add_columns(matrix, -1.0F, level->x, level->y, level->of->own);
        ost_smoother_next(&steps);
        step.keep = (float)steps.keep;
        step.add = (float)steps.add;
        ost_smoother_blocks_step_columns(smoother->blocks, &step, level->y);
    }
    add_sum(n, level->sum, from_zero, (OstColumns *)x);
}

/* On the coarsest level. */
static OstStatus solve(const Level *level, const double *b, double *x)
{
    const size_t n = ost_level_unknowns(level->of->matrix);
    double *left = level->one, *right = level->one + OST_COLUMNS * n, *to[OST_COLUMNS];
    const double *from[OST_COLUMNS];
    for (size_t k = 0; k < OST_COLUMNS; k++) {
        to[k] = right + k * n;
        from[k] = left + k * n;
    }
    ost_columns_unpack(n, OST_COLUMNS, b, to);
    OST_TRY(ost_coarsest_solve(level->of->coarsest, OST_COLUMNS, right, left));
    ost_columns_pack(n, OST_COLUMNS, from, x);
    return OST_SUCCESS;
}

static OstStatus smooth(void *data, const double *b, double *x, int from_zero)
{
    const Level *level = data;
    OstContext *ctx = enter(level);
    if (!level->next)
        ost_ledger_visited(ctx);
    if (level->of->coarsest)
        return leave(level, solve(level, b, x));
    for (int k = 0; k < (level->next ? 1 : OST_COARSEST_SWEEPS); k++)
        sweep(level, b, x, from_zero && k == 0);
    return leave(level, OST_SUCCESS);
}

static OstStatus restrict_to(void *data, const double *fine, double *coarse)
{
    const Level *level = data;
    ost_ledger_visited(enter(level));
    if (level->of->quadratic)
        return leave(level, ost_quadratic_level_restrict_columns(level->of->quadratic, (const OstColumns *)fine,
                                                                 level->of_linear, (OstColumns *)coarse));
    ost_prolongator_restrict_columns(level->of->prolongator, (const OstColumns *)fine, level->coarse,
                                     level->of->coarse);
    for (size_t i = 0; i < ost_level_unknowns(level->next->matrix); i++)
        ((OstColumns *)coarse)[i] = __builtin_convertvector(level->coarse[i], OstColumns);
    return leave(level, OST_SUCCESS);
}

static OstStatus prolong(void *data, const double *coarse, double *fine)
{
    const Level *level = data;
    enter(level);
    if (level->of->quadratic)
        return leave(level, ost_quadratic_level_prolong_columns(level->of->quadratic, (const OstColumns *)coarse,
                                                                level->of_linear, (OstColumns *)fine));
    lighten(ost_level_unknowns(level->next->matrix), coarse, level->coarse);
    ost_prolongator_apply_columns(level->of->prolongator, level->coarse, (OstColumns *)fine, level->of->coarse);
    return leave(level, OST_SUCCESS);
}

static OstStatus create_level(OstContext *ctx, const OstCycle *cycle, int l, Level *level)
{
    const OstCycleLevel *of = &cycle->level[l];
    const size_t size = (size_t)of->matrix->size, columns = size * (size_t)of->matrix->columns;
    *level = (Level){.of = of, .next = l + 1 < cycle->count ? of + 1 : NULL};
    const size_t rows = ost_level_unknowns(of->matrix);
    OST_TRY(OST_NEW(ctx, &level->x, columns + 2 * rows));
    level->y = level->x + columns;
    level->sum = level->y + rows;
    if (of->prolongator)
        OST_TRY(OST_NEW(ctx, &level->coarse, OST_MODES * (size_t)of->prolongator->columns));
    if (of->quadratic)
        OST_TRY(OST_NEW(ctx, &level->of_linear, 3 * (size_t)of->quadratic->space.matrix->columns));
    return of->coarsest ? OST_NEW(ctx, &level->one, 2 * OST_COLUMNS * ost_level_unknowns(of->matrix)) : OST_SUCCESS;
}

static OstStatus hand_to_ml(OstContext *ctx, OstCycleColumns *columns)
{
    OstMlLevel level[OST_MAX_LEVELS + 1] = {{0}};
    OstStatus status = OST_SUCCESS;
    for (int l = 0; l < columns->count && status == OST_SUCCESS; l++) {
        const size_t unknowns = OST_COLUMNS * ost_level_unknowns(columns->level[l].of->matrix);
        if (unknowns > INT_MAX)
            status = OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%zu numbers on a rank are more than ML can number (2^31 - 1)",
                               unknowns);
        level[l] = (OstMlLevel){.data = &columns->level[l],
                                .unknowns = (OstLocal)unknowns,
                                .multiply = multiply,
                                .smooth = smooth,
                                .restrict_to = restrict_to,
                                .prolong = prolong};
    }
    OST_TRY(ost_agree(ctx, status));
    return ost_ml_cycle_create(ctx, columns->count, level, &columns->ml);
}

static OstStatus create(OstContext *ctx, const OstCycle *cycle, OstCycleColumns **columns)
{
    const size_t n = OST_COLUMNS * ost_level_unknowns(cycle->level[0].matrix);
    OstStatus status = OST_NEW(ctx, columns, 1);
    OST_THEN(OST_NEW(ctx, &(*columns)->r, 2 * n));
    for (int l = 0; l < cycle->count && status == OST_SUCCESS; l++) {
        (*columns)->count = l + 1;
        status = create_level(ctx, cycle, l, &(*columns)->level[l]);
    }
    status = ost_agree(ctx, status);
    OST_THEN(hand_to_ml(ctx, *columns));
    if (status != OST_SUCCESS)
        ost_cycle_columns_destroy(columns);
    else
        (*columns)->z = (*columns)->r + n;
    return status;
}

OstStatus ost_cycle_columns_apply(OstCycle *cycle, int half, int count, const double *const *r, double *const *z)
{
    OstContext *ctx = cycle->level[0].matrix->ctx;
    const size_t n = ost_level_unknowns(cycle->level[0].matrix);
    if (!cycle->columns)
        OST_TRY(create(ctx, cycle, &cycle->columns));
    ost_columns_pack(n, count, r, cycle->columns->r);
    OST_TRY(ost_ml_cycle_apply(cycle->columns->ml, half, cycle->columns->r, cycle->columns->z));
    ost_columns_unpack(n, count, cycle->columns->z, z);
    return OST_SUCCESS;
}

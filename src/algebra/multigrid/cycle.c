/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/cycle.h"

#include "algebra/multigrid/cycle_columns.h"
#include "algebra/multigrid/cycle_data.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"

#include <math.h>
#include <string.h>

enum { LARGEST_FACTORED = 50000 }; /* unknowns; where coarsening stopped at a larger level, that is smoothed instead */

enum { BRIEF_DEGREE = 1 }; /* of the finest level's smoother in half a cycle that is brief, or of quadratic tets */

/* Bytes that the factors of a plate's columns may take, over those of the stiffness. */
static const double of_stiffness = 2.0, little = 64e6; /* and so many at least */

static const double careful = 1.2; /* safety factor of an eigenvalue estimate that may be too low */

void ost_cycle_destroy(OstCycle **cycle)
{
    if (!*cycle)
        return;
    ost_cycle_columns_destroy(&(*cycle)->columns);
    ost_ml_cycle_destroy(&(*cycle)->ml);
    for (int l = 0; l < (*cycle)->count; l++) {
        OST_FREE((*cycle)->level[l].own, (*cycle)->level[l].coarse);
    }
    ost_coarsest_destroy(&(*cycle)->coarsest);
    ost_quadratic_level_destroy(&(*cycle)->quadratic);
    ost_levels_clear(&(*cycle)->levels);
    OST_FREE(*cycle);
}

/* Bytes that factors of the coarsest level may take. Those of a plate's columns are those of a flat mesh, small beside
 * the stiffness: they may take as much as it does, whatever its own factors may. */
static OstStatus allow_memory(const OstLevels *levels, const OstSolverOptions *options, double *bytes)
{
    const OstLevelMatrix *finest = levels->matrix[0];
    double stiffness = (double)finest->nonzeros * sizeof(double);
    OST_TRY(ost_sum(finest->ctx, 1, &stiffness));
    *bytes = options->factor_memory;
    if (levels->flat && *bytes > 0.0)
        *bytes = fmax(*bytes, fmax(of_stiffness * stiffness, little));
    return OST_SUCCESS;
}

/* Factors the coarsest level, or makes its smoother if it is too large. Where coarsening stopped early, as all that is
 * left is apart, a smoother does as well: factors that do not fit into memory are left out. */
static OstStatus prepare_coarsest(OstContext *ctx, OstCycle *cycle, const OstSolverOptions *options)
{
    OstLevels *levels = &cycle->levels;
    const int last = levels->count - 1;
    OstGlobal unknowns = (OstGlobal)ost_level_unknowns(levels->matrix[last]);
    double memory = 0.0;
    OstStatus status = ost_sum_numbers(ctx, 1, &unknowns);
    const int needed = levels->flat || levels->count >= options->most_levels;
    int factored = needed || unknowns <= LARGEST_FACTORED;
    if (status == OST_SUCCESS && factored)
        status = allow_memory(levels, options, &memory);
    if (status == OST_SUCCESS && factored)
        status = ost_coarsest_create(levels->coarsest, memory, &cycle->coarsest);
    if (status == OST_OUT_OF_MEMORY && !needed) {
        status = OST_SUCCESS;
        factored = 0;
    }
    if (status == OST_SUCCESS && !factored)
        status = ost_smoother_create(levels->matrix[last], levels->graph[last], options, &levels->smoother[last]);
    ost_double_matrix_destroy(&levels->coarsest);
    ost_metric_graph_destroy(&levels->graph[last]);
    return ost_agree(ctx, status);
}

/* Books what follows to the level, and at the end to none. */
static void enter(const OstCycleLevel *level)
{
    ost_ledger_level(level->matrix->ctx, level->number);
}

static OstStatus leave(const OstCycleLevel *level, OstStatus status)
{
    ost_ledger_level(level->matrix->ctx, -1);
    return status;
}

/* y = A x */
static OstStatus multiply(void *data, const double *x, double *y)
{
    const OstCycleLevel *level = data;
    enter(level);
    const size_t n = ost_level_unknowns(level->matrix);
    if (n > 0) {
        memcpy(level->own, x, n * sizeof *x);
        memset(y, 0, n * sizeof *y);
    }
    ost_level_matrix_add(level->matrix, 1.0, level->own, y);
    return leave(level, OST_SUCCESS);
}

static OstStatus smooth(void *data, const double *b, double *x, int from_zero)
{
    const OstCycleLevel *level = data;
    const int is_last = !level->prolongator && !level->quadratic;
    enter(level);
    if (is_last)
        ost_ledger_visited(level->matrix->ctx);
    if (level->coarsest)
        return leave(level, ost_coarsest_solve(level->coarsest, 1, b, x));
    for (int sweep = 0; sweep < (is_last ? OST_COARSEST_SWEEPS : 1); sweep++)
        ost_smoother_apply(level->smoother, b, x, from_zero && sweep == 0);
    return leave(level, OST_SUCCESS);
}

static OstStatus restrict_to(void *data, const double *fine, double *coarse)
{
    const OstCycleLevel *level = data;
    enter(level);
    ost_ledger_visited(level->matrix->ctx);
    if (level->quadratic)
        return leave(level, ost_quadratic_level_restrict(level->quadratic, fine, coarse));
    ost_prolongator_restrict(level->prolongator, fine, level->coarse);
    const size_t n = ost_level_unknowns(level[1].matrix);
    if (n > 0)
        memcpy(coarse, level->coarse, n * sizeof *coarse);
    return leave(level, OST_SUCCESS);
}

static OstStatus prolong(void *data, const double *coarse, double *fine)
{
    const OstCycleLevel *level = data;
    const size_t n = ost_level_unknowns(level->matrix), coarse_n = ost_level_unknowns(level[1].matrix);
    enter(level);
    if (level->quadratic)
        return leave(level, ost_quadratic_level_prolong(level->quadratic, coarse, fine));
    if (n > 0)
        memset(fine, 0, n * sizeof *fine);
    if (coarse_n > 0)
        memcpy(level->coarse, coarse, coarse_n * sizeof *coarse);
    ost_prolongator_add(level->prolongator, level->coarse, fine);
    return leave(level, OST_SUCCESS);
}

/* Lists the levels, the finest first. */
static OstStatus set_levels(OstContext *ctx, OstCycle *cycle)
{
    const OstLevels *levels = &cycle->levels;
    OstQuadraticLevel *quadratic = cycle->quadratic;
    const int finest = quadratic ? 1 : 0; /* level of the linear tets */
    cycle->count = levels->count + finest;
    if (quadratic)
        cycle->level[0] =
            (OstCycleLevel){.matrix = quadratic->matrix, .smoother = quadratic->smoother, .quadratic = quadratic};
    for (int l = 0; l < levels->count; l++)
        cycle->level[finest + l] = (OstCycleLevel){
            .matrix = levels->matrix[l], .smoother = levels->smoother[l], .prolongator = levels->prolongator[l]};
    cycle->level[cycle->count - 1].coarsest = cycle->coarsest;
    for (int l = 0; l < cycle->count; l++) {
        OstCycleLevel *level = &cycle->level[l];
        level->number = l;
        OST_TRY(ost_level_vector_create(ctx, level->matrix->size, (size_t)level->matrix->columns, &level->own));
        if (level->prolongator)
            OST_TRY(ost_level_vector_create(ctx, OST_MODES, (size_t)level->prolongator->columns, &level->coarse));
    }
    return OST_SUCCESS;
}

static OstStatus hand_to_ml(OstContext *ctx, OstCycle *cycle)
{
    OstMlLevel level[OST_MAX_LEVELS + 1] = {{0}};
    if (cycle->count == 1)
        return OST_SUCCESS;
    for (int l = 0; l < cycle->count; l++)
        level[l] = (OstMlLevel){.data = &cycle->level[l],
                                .unknowns = (OstLocal)ost_level_unknowns(cycle->level[l].matrix),
                                .multiply = multiply,
                                .smooth = smooth,
                                .restrict_to = restrict_to,
                                .prolong = prolong};
    return ost_ml_cycle_create(ctx, cycle->count, level, &cycle->ml);
}

OstStatus ost_cycle_create(OstContext *ctx, OstLevels *levels, OstQuadraticLevel **quadratic,
                           const OstSolverOptions *options, OstCycle **cycle)
{
    OstCycle *made = NULL;
    *cycle = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    made->levels = *levels;
    made->quadratic = *quadratic;
    memset(levels, 0, sizeof *levels);
    *quadratic = NULL;
    OST_TRY_DONE(prepare_coarsest(ctx, made, options));
    OST_TRY_DONE(ost_agree(ctx, set_levels(ctx, made)));
    OST_TRY_DONE(hand_to_ml(ctx, made));
done:
    if (status != OST_SUCCESS)
        ost_cycle_destroy(&made);
    *cycle = made;
    return status;
}

/* A vector to be preconditioned, and where the result goes. */
typedef struct Request {
    const double *r;
    double *z;
} Request;

static OstStatus apply_one(OstCycle *cycle, int half, const Request *request)
{
    return cycle->ml ? ost_ml_cycle_apply(cycle->ml, half, request->r, request->z)
                     : smooth(&cycle->level[0], request->r, request->z, 1);
}

static OstStatus apply_all(OstCycle *cycle, int half, int count, void *const *request)
{
    const double *r[OST_MOST_TOGETHER];
    double *z[OST_MOST_TOGETHER];
    for (int k = 0; k < count; k++) {
        r[k] = ((const Request *)request[k])->r;
        z[k] = ((const Request *)request[k])->z;
    }
    const int fit = ost_cycle_columns_fit(cycle);
    for (int k = 0, next = 1; k < count; k += next) {
        next = fit ? ost_columns_next(count - k) : 1;
        OST_TRY(next > 1 ? ost_cycle_columns_apply(cycle, half, next, r + k, z + k)
                         : apply_one(cycle, half, request[k]));
    }
    return OST_SUCCESS;
}

/* OstServe, all three. */
static OstStatus apply_whole(void *cycle, int count, void *const *request)
{
    return apply_all(cycle, 0, count, request);
}

static OstStatus apply_brief(void *data, int count, void *const *request)
{
    OstCycle *cycle = data;
    OstSmoother *smoother = cycle->level[0].smoother;
    const int degree = smoother ? smoother->degree : 0;
    if (smoother)
        smoother->degree = BRIEF_DEGREE;
    const OstStatus status = apply_all(cycle, 1, count, request);
    if (smoother)
        smoother->degree = degree;
    return status;
}

static OstStatus apply_half(void *data, int count, void *const *request)
{
    const OstCycle *cycle = data;
    return cycle->quadratic ? apply_brief(data, count, request) : apply_all(data, 1, count, request);
}

OstStatus ost_cycle_apply(void *data, const double *r, double *z)
{
    OstCycle *cycle = data;
    Request request = {r, z};
    return ost_together(cycle->level[0].matrix->ctx, apply_whole, OST_COLUMNS, cycle, &request);
}

OstStatus ost_cycle_apply_half(void *data, const double *r, double *z)
{
    OstCycle *cycle = data;
    Request request = {r, z};
    return ost_together(cycle->level[0].matrix->ctx, apply_half, OST_COLUMNS, cycle, &request);
}

OstStatus ost_cycle_apply_brief(void *data, const double *r, double *z)
{
    OstCycle *cycle = data;
    Request request = {r, z};
    return ost_together(cycle->level[0].matrix->ctx, apply_brief, OST_COLUMNS, cycle, &request);
}

void ost_cycle_strengthen(OstCycle *cycle, int more, double ratio)
{
    for (int l = 0; l < cycle->count; l++) {
        OstSmoother *smoother = cycle->level[l].smoother;
        if (!smoother)
            continue;
        smoother->degree += more;
        smoother->ratio = ratio * careful;
        /* The estimate approaches the eigenvalue from below; a Chebyshev polynomial is indefinite beyond its interval.
         */
        smoother->largest *= careful;
    }
}

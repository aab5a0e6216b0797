/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/cycle.h"

#include "algebra/trilinos/ml.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/reduce.h"

#include <string.h>

/* Of what the second visit adds. Iterations hardly differ from 2 to 2.5; the larger it is, the less may eigenvalues of
 * the cycle be above 1. */
static const double second_weight = 2.25;

typedef struct Level {
    OstMlCycle *cycle;
    OstMlLevel operators;
    double *first; /* the result of the first visit; NULL if there is only one */
    int second;    /* is this the second visit? */
} Level;

struct OstMlCycle {
    ML *ml;
    int levels;
    Level *level;
    int half;         /* is the finest level left at zero before the others? */
    OstStatus status; /* the first failure inside a callback: ML cannot pass it on */
};

static int note(OstMlCycle *cycle, OstStatus status)
{
    if (cycle->status == OST_SUCCESS)
        cycle->status = status;
    return 0;
}

static int multiply(ML_Operator *operator, int in_length, double *x, int out_length, double *y)
{
    Level *level = ML_Get_MyMatvecData(operator);
    (void)in_length;
    (void)out_length;
    if (level->cycle->half && level == level->cycle->level) { /* x is zero */
        memset(y, 0, (size_t)level->operators.unknowns * sizeof *y);
        return 0;
    }
    return note(level->cycle, level->operators.multiply(level->operators.data, x, y));
}

static int restrict_to(ML_Operator *operator, int in_length, double *fine, int out_length, double *coarse)
{
    Level *level = ML_Get_MyMatvecData(operator);
    (void)in_length;
    (void)out_length;
    return note(level->cycle, level->operators.restrict_to(level->operators.data, fine, coarse));
}

static int prolong(ML_Operator *operator, int in_length, double *coarse, int out_length, double *fine)
{
    Level *level = ML_Get_MyMatvecData(operator);
    (void)in_length;
    (void)out_length;
    return note(level->cycle, level->operators.prolong(level->operators.data, coarse, fine));
}

/* ML starts the second visit to a level from the result of the first, which is stored. */
static int smooth_before(ML_Smoother *smoother, int in_length, double *x, int out_length, double *b)
{
    Level *level = ML_Get_MySmootherData(smoother);
    const int from_zero = smoother->init_guess == ML_ZERO;
    (void)in_length;
    (void)out_length;
    level->second = level->first && !from_zero;
    if (level->cycle->half && level == level->cycle->level)
        return 0;
    if (level->second)
        memcpy(level->first, x, (size_t)level->operators.unknowns * sizeof *x);
    return note(level->cycle, level->operators.smooth(level->operators.data, b, x, from_zero));
}

/* What the second visit adds to the first is weighted. */
static int smooth_after(ML_Smoother *smoother, int in_length, double *x, int out_length, double *b)
{
    Level *level = ML_Get_MySmootherData(smoother);
    (void)in_length;
    (void)out_length;
    note(level->cycle, level->operators.smooth(level->operators.data, b, x, 0));
    for (OstLocal i = 0; level->second && i < level->operators.unknowns; i++)
        x[i] = level->first[i] + second_weight * (x[i] - level->first[i]);
    return 0;
}

/* Passes level l to ML. On the last level ML calls only the pre-smoother, which solves. */
static OstStatus set_level(OstContext *ctx, OstMlCycle *cycle, int l)
{
    ML *ml = cycle->ml;
    Level *level = &cycle->level[l];
    const int n = level->operators.unknowns;
    int failed = ML_Init_Amatrix(ml, l, n, n, level);
    failed |= ML_Set_Amatrix_Matvec(ml, l, multiply);
    failed |= ML_Set_Smoother(ml, l, ML_PRESMOOTHER, level, smooth_before, NULL);
    if (l + 1 < cycle->levels) {
        const int coarse = level[1].operators.unknowns;
        failed |= ML_Set_Smoother(ml, l, ML_POSTSMOOTHER, level, smooth_after, NULL);
        failed |= ML_Init_Restrictor(ml, l, l + 1, n, coarse, level);
        failed |= ML_Set_Restrictor_Matvec(ml, l, restrict_to);
        failed |= ML_Init_Prolongator(ml, l + 1, l, coarse, n, level);
        failed |= ML_Set_Prolongator_Matvec(ml, l + 1, prolong);
    }
    return failed ? OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML would not take level %d of %d", l, cycle->levels)
                  : OST_SUCCESS;
}

static OstStatus create_levels(OstContext *ctx, OstMlCycle *cycle, const OstMlLevel *level)
{
    OST_TRY(OST_NEW(ctx, &cycle->level, cycle->levels));
    for (int l = 0; l < cycle->levels; l++) {
        cycle->level[l].cycle = cycle;
        cycle->level[l].operators = level[l];
        if (l > 0 && l + 1 < cycle->levels)
            OST_TRY(OST_NEW(ctx, &cycle->level[l].first, level[l].unknowns));
    }
    OST_TRY(ost_ml_create(ctx, cycle->levels, &cycle->ml));
    for (int l = 0; l < cycle->levels; l++)
        OST_TRY(set_level(ctx, cycle, l));
    if (ML_Gen_Solver(cycle->ml, ML_MGW, 0, cycle->levels - 1) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Gen_Solver failed for %d levels", cycle->levels);
    return OST_SUCCESS;
}

/* ML ends the process where a level has no fewer unknowns than the one before. */
static OstStatus check_sizes(OstContext *ctx, int levels, const OstMlLevel *level)
{
    OstGlobal before = 0;
    for (int l = 0; l < levels; l++) {
        OstGlobal unknowns = level[l].unknowns;
        OST_TRY(ost_sum_numbers(ctx, 1, &unknowns));
        if (unknowns == 0 || (l > 0 && unknowns >= before))
            return OST_RAISE(
                ctx, OST_LIMIT_EXCEEDED,
                "level %d of the multigrid cycle would have %lld unknowns, which are none or no fewer than "
                "the %lld of the level before",
                l, (long long)unknowns, (long long)before);
        before = unknowns;
    }
    return OST_SUCCESS;
}

OstStatus ost_ml_cycle_create(OstContext *ctx, int levels, const OstMlLevel *level, OstMlCycle **cycle)
{
    enum { VECTORS = 3 }; /* that ML allocates for each level during a cycle */
    double bytes = 0.0;
    OstMlCycle *made = NULL;
    *cycle = NULL;
    for (int l = 0; l < levels; l++)
        bytes += (double)VECTORS * sizeof(double) * level[l].unknowns;
    OstStatus status;
    OST_TRY_DONE(check_sizes(ctx, levels, level));
    OST_TRY_DONE(ost_memory_foresee(ctx, bytes, "ML's cycle"));
    status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->levels = levels;
        status = create_levels(ctx, made, level);
    }
    status = ost_agree(ctx, status);
done:
    if (status != OST_SUCCESS)
        ost_ml_cycle_destroy(&made);
    *cycle = made;
    return status;
}

void ost_ml_cycle_destroy(OstMlCycle **cycle)
{
    if (!*cycle)
        return;
    for (int l = 0; (*cycle)->level && l < (*cycle)->levels; l++)
        OST_FREE((*cycle)->level[l].first);
    OST_FREE((*cycle)->level);
    if ((*cycle)->ml)
        ML_Destroy(&(*cycle)->ml);
    OST_FREE(*cycle);
}

OstStatus ost_ml_cycle_apply(OstMlCycle *cycle, int half, const double *r, double *z)
{
    ML *ml = cycle->ml;
    cycle->half = half;
    ml->ML_scheme = half ? ML_MGV : ML_MGW;
    if (half) /* else the first smoothing writes it */
        memset(z, 0, (size_t)cycle->level[0].operators.unknowns * sizeof *z);
    ML_Cycle_MG(&ml->SingleLevel[0], z, (double *)r, ML_ZERO, ml->comm, ML_NO_RES_NORM, ml);
    return cycle->status;
}

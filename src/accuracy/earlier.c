/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/earlier.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

/* A solution is kept if so much of its energy is not that of the others. */
static const double least_new = 1e-4;

OstStatus ost_earlier_create(OstContext *ctx, size_t rows, size_t functions, OstEarlier **earlier)
{
    OST_TRY(OST_NEW(ctx, earlier, 1));
    **earlier = (OstEarlier){.ctx = ctx, .rows = rows, .functions = functions};
    OST_TRY(OST_NEW(ctx, &(*earlier)->left.rows, rows));
    return OST_NEW(ctx, &(*earlier)->left.functions, functions);
}

void ost_earlier_destroy(OstEarlier **earlier)
{
    if (!*earlier)
        return;
    for (int k = 0; k < OST_MOST_EARLIER; k++) {
        OST_FREE((*earlier)->x[k]);
        OST_FREE((*earlier)->ax[k]);
    }
    OST_FREE((*earlier)->left.rows);
    OST_FREE((*earlier)->left.functions);
    OST_FREE(*earlier);
}

/* Local. a'b */
static double product(const OstEarlier *earlier, const float *a, const OstEnriched *b)
{
    const float *of_functions = a + earlier->rows;
    double sum = 0.0;
    for (size_t i = 0; i < earlier->rows; i++)
        sum += (double)a[i] * b->rows[i];
    for (size_t i = 0; i < earlier->functions; i++)
        sum += (double)of_functions[i] * (double)b->functions[i];
    return sum;
}

/* b += share a */
static void add(const OstEarlier *earlier, double share, const float *a, const OstEnriched *b)
{
    const float *of_functions = a + earlier->rows, factor = (float)share;
    for (size_t i = 0; i < earlier->rows; i++)
        b->rows[i] += share * (double)a[i];
    for (size_t i = 0; i < earlier->functions; i++)
        b->functions[i] += factor * of_functions[i];
}

OstStatus ost_earlier_start(OstEarlier *earlier, const OstEnriched *r, double *square)
{
    memset(earlier->share, 0, sizeof earlier->share);
    for (int k = 0; k < earlier->count; k++)
        earlier->share[k] = product(earlier, earlier->x[k], r);
    OST_TRY(ost_sum(earlier->ctx, earlier->count, earlier->share));
    earlier->square = 0.0;
    for (int k = 0; k < earlier->count; k++) {
        earlier->square += earlier->share[k] * earlier->share[k];
        add(earlier, -earlier->share[k], earlier->ax[k], r);
    }
    *square = earlier->square;
    memcpy(earlier->left.rows, r->rows, earlier->rows * sizeof *r->rows);
    memcpy(earlier->left.functions, r->functions, earlier->functions * sizeof *r->functions);
    return OST_SUCCESS;
}

/* Takes the others off the last pair, whose energy was 1, and scales what is left; drops it if that is little. */
static OstStatus keep(OstEarlier *earlier)
{
    const size_t size = earlier->rows + earlier->functions;
    float *x = earlier->x[earlier->count], *ax = earlier->ax[earlier->count];
    double share[OST_MOST_EARLIER] = {0.0}, energy = 0.0;
    for (int k = 0; k < earlier->count; k++)
        for (size_t i = 0; i < size; i++)
            share[k] += (double)earlier->ax[k][i] * (double)x[i];
    OST_TRY(ost_sum(earlier->ctx, earlier->count, share));
    for (int k = 0; k < earlier->count; k++)
        for (size_t i = 0; i < size; i++) {
            x[i] -= (float)share[k] * earlier->x[k][i];
            ax[i] -= (float)share[k] * earlier->ax[k][i];
        }
    for (size_t i = 0; i < size; i++)
        energy += (double)x[i] * (double)ax[i];
    OST_TRY(ost_sum(earlier->ctx, 1, &energy));
    if (!(energy > least_new)) {
        OST_FREE(earlier->x[earlier->count]);
        OST_FREE(earlier->ax[earlier->count]);
        return OST_SUCCESS;
    }
    const float scale = (float)(1.0 / sqrt(energy));
    for (size_t i = 0; i < size; i++) {
        x[i] *= scale;
        ax[i] *= scale;
    }
    earlier->count++;
    return OST_SUCCESS;
}

/* Scaled before they are rounded: numbers have any unit. */
static OstStatus take(OstEarlier *earlier, const OstEnriched *r, const OstEnriched *x)
{
    const OstEnriched *left = &earlier->left;
    const size_t size = earlier->rows + earlier->functions;
    double energy = 0.0;
    for (size_t i = 0; i < earlier->rows; i++)
        energy += x->rows[i] * (left->rows[i] - r->rows[i]);
    for (size_t i = 0; i < earlier->functions; i++)
        energy += (double)x->functions[i] * (double)(left->functions[i] - r->functions[i]);
    OST_TRY(ost_sum(earlier->ctx, 1, &energy));
    if (!(energy > least_new * earlier->square) || !isfinite(energy))
        return OST_SUCCESS;
    OstStatus status = OST_NEW(earlier->ctx, &earlier->x[earlier->count], size);
    OST_THEN(OST_NEW(earlier->ctx, &earlier->ax[earlier->count], size));
    OST_TRY(ost_agree(earlier->ctx, status));
    const double scale = 1.0 / sqrt(energy);
    float *kept = earlier->x[earlier->count], *a_kept = earlier->ax[earlier->count];
    for (size_t i = 0; i < earlier->rows; i++) {
        kept[i] = (float)(scale * x->rows[i]);
        a_kept[i] = (float)(scale * (left->rows[i] - r->rows[i]));
    }
    for (size_t i = 0; i < earlier->functions; i++) {
        kept[earlier->rows + i] = (float)(scale * (double)x->functions[i]);
        a_kept[earlier->rows + i] = (float)(scale * (double)(left->functions[i] - r->functions[i]));
    }
    return keep(earlier);
}

OstStatus ost_earlier_finish(OstEarlier *earlier, const OstEnriched *r, const OstEnriched *x)
{
    const int others = earlier->count;
    if (others < OST_MOST_EARLIER)
        OST_TRY(take(earlier, r, x));
    for (int k = 0; k < others; k++)
        add(earlier, earlier->share[k], earlier->x[k], x);
    return OST_SUCCESS;
}

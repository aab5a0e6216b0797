/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/earlier.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

/* A solution is kept if so much of its energy is not that of the others. */
static const double least_new = 1e-4;

OstStatus ost_earlier_create(OstContext *ctx, size_t size, OstEarlier **earlier)
{
    OST_TRY(OST_NEW(ctx, earlier, 1));
    **earlier = (OstEarlier){.ctx = ctx, .size = size};
    return OST_NEW(ctx, &(*earlier)->left, size);
}

void ost_earlier_destroy(OstEarlier **earlier)
{
    if (!*earlier)
        return;
    for (int k = 0; k < OST_MOST_EARLIER; k++) {
        OST_FREE((*earlier)->x[k]);
        OST_FREE((*earlier)->ax[k]);
    }
    OST_FREE((*earlier)->left);
    OST_FREE(*earlier);
}

OstStatus ost_earlier_start(OstEarlier *earlier, double *r, double *square)
{
    memset(earlier->share, 0, sizeof earlier->share);
    for (int k = 0; k < earlier->count; k++)
        for (size_t i = 0; i < earlier->size; i++)
            earlier->share[k] += (double)earlier->x[k][i] * r[i];
    OST_TRY(ost_sum(earlier->ctx, earlier->count, earlier->share));
    earlier->square = 0.0;
    for (int k = 0; k < earlier->count; k++) {
        earlier->square += earlier->share[k] * earlier->share[k];
        for (size_t i = 0; i < earlier->size; i++)
            r[i] -= earlier->share[k] * (double)earlier->ax[k][i];
    }
    *square = earlier->square;
    for (size_t i = 0; i < earlier->size; i++)
        earlier->left[i] = r[i];
    return OST_SUCCESS;
}

/* Takes the others off the last pair, whose energy was 1, and scales what is left; drops it if that is little. */
static OstStatus keep(OstEarlier *earlier)
{
    float *x = earlier->x[earlier->count], *ax = earlier->ax[earlier->count];
    double share[OST_MOST_EARLIER] = {0.0}, energy = 0.0;
    for (int k = 0; k < earlier->count; k++)
        for (size_t i = 0; i < earlier->size; i++)
            share[k] += (double)earlier->ax[k][i] * (double)x[i];
    OST_TRY(ost_sum(earlier->ctx, earlier->count, share));
    for (int k = 0; k < earlier->count; k++)
        for (size_t i = 0; i < earlier->size; i++) {
            x[i] -= (float)share[k] * earlier->x[k][i];
            ax[i] -= (float)share[k] * earlier->ax[k][i];
        }
    for (size_t i = 0; i < earlier->size; i++)
        energy += (double)x[i] * (double)ax[i];
    OST_TRY(ost_sum(earlier->ctx, 1, &energy));
    if (!(energy > least_new)) {
        OST_FREE(earlier->x[earlier->count]);
        OST_FREE(earlier->ax[earlier->count]);
        return OST_SUCCESS;
    }
    const float scale = (float)(1.0 / sqrt(energy));
    for (size_t i = 0; i < earlier->size; i++) {
        x[i] *= scale;
        ax[i] *= scale;
    }
    earlier->count++;
    return OST_SUCCESS;
}

/* Scaled before they are rounded: numbers have any unit. */
static OstStatus take(OstEarlier *earlier, const double *r, const double *x)
{
    double energy = 0.0;
    for (size_t i = 0; i < earlier->size; i++)
        energy += x[i] * (earlier->left[i] - r[i]);
    OST_TRY(ost_sum(earlier->ctx, 1, &energy));
    if (!(energy > least_new * earlier->square) || !isfinite(energy))
        return OST_SUCCESS;
    OstStatus status = OST_NEW(earlier->ctx, &earlier->x[earlier->count], earlier->size);
    OST_THEN(OST_NEW(earlier->ctx, &earlier->ax[earlier->count], earlier->size));
    OST_TRY(ost_agree(earlier->ctx, status));
    for (size_t i = 0; i < earlier->size; i++) {
        earlier->x[earlier->count][i] = (float)(x[i] / sqrt(energy));
        earlier->ax[earlier->count][i] = (float)((earlier->left[i] - r[i]) / sqrt(energy));
    }
    return keep(earlier);
}

OstStatus ost_earlier_finish(OstEarlier *earlier, const double *r, double *x)
{
    const int others = earlier->count;
    if (others < OST_MOST_EARLIER)
        OST_TRY(take(earlier, r, x));
    for (int k = 0; k < others; k++)
        for (size_t i = 0; i < earlier->size; i++)
            x[i] += earlier->share[k] * (double)earlier->x[k][i];
    return OST_SUCCESS;
}

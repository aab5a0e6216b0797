/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/node_factor.h"

#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/small.h"

#include <metis.h>
#include <stdlib.h>
#include <string.h>

void ost_node_factor_clear(OstNodeFactor *factor)
{
    OST_FREE(factor->start, factor->row, factor->diagonal, factor->value);
}

static OstStatus dissect(OstContext *ctx, OstLocal count, const OstLocal *start, const OstLocal *neighbour,
                         OstLocal *order, OstLocal *place)
{
    enum { SEED = 20140721 }; /* any fixed number: the same patch always has the same order */
    idx_t options[METIS_NOPTIONS], nodes = count, *list = NULL;
    const size_t n = (size_t)count, edges = (size_t)start[count];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = SEED;
    for (OstLocal i = 0; i < count && edges == 0; i++)
        order[i] = place[i] = i;
    if (edges == 0)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(ctx, &list, 3 * n + 1 + edges));
    idx_t *from = list, *to = list + n + 1, *old = to + edges, *new = old + n;
    for (size_t i = 0; i <= n; i++)
        from[i] = start[i];
    for (size_t k = 0; k < edges; k++)
        to[k] = neighbour[k];
    const int result = METIS_NodeND(&nodes, from, to, NULL, options, old, new);
    for (size_t i = 0; i < n && result == METIS_OK; i++) {
        order[i] = (OstLocal)old[i];
        place[i] = (OstLocal) new[i];
    }
    OST_FREE(list);
    return result == METIS_OK ? OST_SUCCESS
                              : OST_RAISE(ctx, OST_LIBRARY_FAILED, "METIS could not order a patch (code %d)", result);
}

static int compare(const void *a, const void *b)
{
    const OstLocal first = *(const OstLocal *)a, second = *(const OstLocal *)b;
    return (first > second) - (first < second);
}

/* The columns' rows: of each, its neighbours that come later, and those of the columns whose first row it is. */
static OstStatus find_pattern(OstContext *ctx, const OstLocal *start, const OstLocal *neighbour, const OstLocal *order,
                              const OstLocal *place, OstNodeFactor *factor)
{
    const OstLocal count = factor->count;
    OstLocal *seen = NULL, *child = NULL, *next = NULL, room = 0, used = 0;
    OstStatus status;
    OST_TRY_DONE(OST_NEW(ctx, &factor->start, count + 1));
    OST_TRY_DONE(OST_NEW(ctx, &seen, 3 * (size_t)count));
    child = seen + count; /* 1 + the first of a column's children, and of each its next sibling; 0: none */
    next = child + count;
    for (OstLocal n = 0; n < count; n++) {
        if (used + count > room) {
            room = 2 * room + count;
            OST_TRY_DONE(OST_RESIZE(ctx, &factor->row, room));
        }
        seen[n] = n + 1;
        for (OstLocal k = start[order[n]]; k < start[order[n] + 1]; k++) {
            const OstLocal i = place[neighbour[k]];
            if (i > n && seen[i] != n + 1)
                factor->row[used++] = i;
            seen[i] = i > n ? n + 1 : seen[i];
        }
        for (OstLocal c = child[n]; c > 0; c = next[c - 1])
            for (OstLocal k = factor->start[c - 1]; k < factor->start[c]; k++) {
                const OstLocal i = factor->row[k];
                if (seen[i] != n + 1)
                    factor->row[used++] = i;
                seen[i] = n + 1;
            }
        factor->start[n + 1] = used;
        OstLocal *rows = factor->row + factor->start[n];
        qsort(rows, (size_t)(used - factor->start[n]), sizeof *rows, compare);
        if (used > factor->start[n]) {
            next[n] = child[rows[0]];
            child[rows[0]] = n + 1;
        }
    }
done:
    OST_FREE(seen);
    return status;
}

OstStatus ost_node_factor_plan(OstContext *ctx, OstLocal count, const OstLocal *start, const OstLocal *neighbour,
                               OstLocal *order, OstNodeFactor *factor)
{
    OstLocal *place = NULL;
    *factor = (OstNodeFactor){.count = count};
    OstStatus status = OST_NEW(ctx, &place, count);
    OST_THEN(dissect(ctx, count, start, neighbour, order, place));
    OST_THEN(find_pattern(ctx, start, neighbour, order, place, factor));
    OST_FREE(place);
    if (status != OST_SUCCESS)
        ost_node_factor_clear(factor);
    return status;
}

OstLocal ost_node_factor_find(const OstNodeFactor *factor, OstLocal row, OstLocal column)
{
    OstLocal low = factor->start[column], high = factor->start[column + 1] - 1;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (factor->row[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The inverse of a block's Cholesky factor, in place; 0 if it is not positive definite. */
static int invert_factor(double a[9])
{
    double inverse[9] = {0.0};
    if (ost_cholesky(3, a) != 0)
        return 0;
    for (int c = 0; c < 3; c++)
        for (int r = c; r < 3; r++) {
            double sum = r == c ? 1.0 : 0.0;
            for (int k = c; k < r; k++)
                sum -= a[3 * r + k] * inverse[3 * k + c];
            inverse[3 * r + c] = sum / a[3 * r + r];
        }
    memcpy(a, inverse, sizeof inverse);
    return 1;
}

/* target -= a bᵀ */
static inline void subtract(const double a[9], const double b[9], double *restrict target)
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            target[3 * r + c] -= a[3 * r] * b[3 * c] + a[3 * r + 1] * b[3 * c + 1] + a[3 * r + 2] * b[3 * c + 2];
}

/* Takes column n, which is done, from the later ones. */
static void take_column(const OstNodeFactor *factor, OstLocal n, double *diagonal, double *value)
{
    const OstLocal end = factor->start[n + 1];
    for (OstLocal a = factor->start[n]; a < end; a++) {
        const OstLocal j = factor->row[a];
        const double *left = value + 9 * (size_t)a;
        subtract(left, left, diagonal + 9 * (size_t)j);
        OstLocal k = factor->start[j];
        for (OstLocal b = a + 1; b < end; b++, k++) {
            while (factor->row[k] < factor->row[b])
                k++;
            subtract(value + 9 * (size_t)b, left, value + 9 * (size_t)k);
        }
    }
}

OST_KERNEL static int factor_blocks(const OstNodeFactor *factor, double *diagonal, double *value)
{
    for (OstLocal n = 0; n < factor->count; n++) {
        double *inverse = diagonal + 9 * (size_t)n;
        if (!invert_factor(inverse))
            return n + 1;
        for (OstLocal k = factor->start[n]; k < factor->start[n + 1]; k++) {
            double *block = value + 9 * (size_t)k, left[9] = {0.0};
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    for (int m = 0; m <= c; m++)
                        left[3 * r + c] += block[3 * r + m] * inverse[3 * c + m];
            memcpy(block, left, sizeof left);
        }
        take_column(factor, n, diagonal, value);
    }
    return 0;
}

OstStatus ost_node_factor_fill(OstContext *ctx, double *diagonal, double *value, OstNodeFactor *factor, int *pivot)
{
    const size_t on = 9 * (size_t)factor->count, below = 9 * (size_t)factor->start[factor->count];
    *pivot = factor_blocks(factor, diagonal, value);
    if (*pivot != 0)
        return OST_SUCCESS;
    OST_TRY(OST_NEW_UNCLEARED(ctx, &factor->diagonal, on));
    OST_TRY(OST_NEW_UNCLEARED(ctx, &factor->value, below));
    for (size_t k = 0; k < on; k++)
        factor->diagonal[k] = (float)diagonal[k];
    for (size_t k = 0; k < below; k++)
        factor->value[k] = (float)value[k];
    return OST_SUCCESS;
}

OST_KERNEL void ost_node_factor_solve(const OstNodeFactor *factor, float *x)
{
    for (OstLocal n = 0; n < factor->count; n++) {
        const float *d = factor->diagonal + 9 * (size_t)n;
        float *at = x + 3 * (size_t)n;
        const float y[3] = {d[0] * at[0], d[3] * at[0] + d[4] * at[1], d[6] * at[0] + d[7] * at[1] + d[8] * at[2]};
        memcpy(at, y, sizeof y);
        for (OstLocal k = factor->start[n]; k < factor->start[n + 1]; k++) {
            const float *block = factor->value + 9 * (size_t)k;
            float *to = x + 3 * (size_t)factor->row[k];
            for (int r = 0; r < 3; r++)
                to[r] -= block[3 * r] * y[0] + block[3 * r + 1] * y[1] + block[3 * r + 2] * y[2];
        }
    }
    for (OstLocal n = factor->count - 1; n >= 0; n--) {
        const float *d = factor->diagonal + 9 * (size_t)n;
        float *at = x + 3 * (size_t)n;
        float y[3] = {at[0], at[1], at[2]};
        for (OstLocal k = factor->start[n]; k < factor->start[n + 1]; k++) {
            const float *block = factor->value + 9 * (size_t)k;
            const float *from = x + 3 * (size_t)factor->row[k];
            for (int c = 0; c < 3; c++)
                y[c] -= block[c] * from[0] + block[3 + c] * from[1] + block[6 + c] * from[2];
        }
        at[0] = d[0] * y[0] + d[3] * y[1] + d[6] * y[2];
        at[1] = d[4] * y[1] + d[7] * y[2];
        at[2] = d[8] * y[2];
    }
}

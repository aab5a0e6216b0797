/* SPDX-License-Identifier: BSD-3-Clause */

#include "accuracy/search.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

/* Of a residual that is a sum, what single precision leaves of the difference. */
static const double small_difference = 1e-3;

void ost_sum_clear(OstKeptError *kept)
{
    OST_FREE(kept->rows);
    OST_FREE(kept->functions);
    OST_FREE(kept->residual);
    *kept = (OstKeptError){0};
}

OstStatus ost_sum_keep_residual(const Search *search)
{
    const OstSteps *steps = &search->steps;
    OstContext *ctx = search->estimate->problem->ctx;
    const size_t numbers = OST_PER_FUNCTION * steps->functions;
    OstKeptError *kept = &search->estimate->kept;
    if (!search->estimate->keeps)
        return OST_SUCCESS;
    ost_sum_clear(kept);
    OstStatus status = OST_NEW(ctx, &kept->rows, steps->rows);
    OST_THEN(OST_NEW(ctx, &kept->functions, numbers));
    OST_THEN(OST_NEW(ctx, &kept->residual, numbers));
    OST_TRY(ost_agree(ctx, status));
    memcpy(kept->residual, steps->r.functions, numbers * sizeof *kept->residual);
    return OST_SUCCESS;
}

OstStatus ost_sum_keep_error(const Search *search, double square, int is_settled)
{
    const OstSteps *steps = &search->steps;
    OstKeptError *kept = &search->estimate->kept;
    if (!search->estimate->keeps || !(search->of_tets > 0.0) || !isfinite(square))
        return OST_SUCCESS;
    memcpy(kept->rows, steps->e.rows, steps->rows * sizeof *kept->rows);
    memcpy(kept->functions, steps->e.functions, OST_PER_FUNCTION * steps->functions * sizeof *kept->functions);
    kept->size = steps->size;
    kept->square = square;
    kept->stretch = square / search->of_tets;
    kept->longer = search->longer;
    kept->is_settled = is_settled;
    kept->is_known = 1;
    return OST_SUCCESS;
}

/* Do the residuals add up? */
static OstStatus compare(const Search *search, const float *factor, int *same)
{
    const OstEstimate *estimate = search->estimate;
    const float *r = search->steps.r.functions;
    double squares[2] = {0.0};
    for (size_t i = 0; i < OST_PER_FUNCTION * search->steps.functions; i++) {
        float left = r[i];
        for (int k = 0; k < estimate->part_count; k++)
            left -= factor[k] * estimate->part[k]->kept.residual[i];
        squares[0] += (double)left * (double)left;
        squares[1] += (double)r[i] * (double)r[i];
    }
    OST_TRY(ost_sum(estimate->problem->ctx, 2, squares));
    *same = squares[0] <= small_difference * small_difference * squares[1];
    return OST_SUCCESS;
}

/* Steps that were not taken would add to each as they would alone: to the sum by the mean. */
static void lengthen(Search *search)
{
    const OstEstimate *estimate = search->estimate;
    double total = 0.0;
    search->stretch = search->longer = 0.0;
    for (int k = 0; k < estimate->part_count; k++) {
        const OstKeptError *kept = &estimate->part[k]->kept;
        const double weight = estimate->part_factor[k] * estimate->part_factor[k] * kept->square;
        total += weight;
        search->stretch += weight * kept->stretch;
        search->longer += weight * kept->longer;
    }
    search->stretch = total > 0.0 ? search->stretch / total : 1.0;
    search->longer = total > 0.0 ? search->longer / total : 1.0;
}

OstStatus ost_sum_take(Search *search, int needs_settled, int *found)
{
    const OstEstimate *estimate = search->estimate;
    OstSteps *steps = &search->steps;
    float factor[OST_MOST_PARTS];
    *found = estimate->part_count > 0;
    for (int k = 0; k < estimate->part_count; k++) {
        const OstKeptError *kept = &estimate->part[k]->kept;
        *found &= kept->is_known && (kept->is_settled || !needs_settled);
        factor[k] = (float)(estimate->part_factor[k] * kept->size / steps->size);
    }
    if (*found)
        OST_TRY(compare(search, factor, found));
    for (int k = 0; k < estimate->part_count && *found; k++) {
        const OstKeptError *kept = &estimate->part[k]->kept;
        for (size_t i = 0; i < steps->rows; i++)
            steps->e.rows[i] += (double)factor[k] * kept->rows[i];
        for (size_t i = 0; i < OST_PER_FUNCTION * steps->functions; i++)
            steps->e.functions[i] += factor[k] * kept->functions[i];
    }
    if (*found)
        lengthen(search);
    return OST_SUCCESS;
}

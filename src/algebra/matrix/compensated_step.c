/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/compensated_step.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

OstStatus ost_compensated_step_create(const OstBlockMatrix *matrix, OstCompensatedStep **step)
{
    OstContext *ctx = matrix->ctx;
    const size_t n = 3 * (size_t)matrix->rows;
    OstStatus status = OST_NEW(ctx, step, 1);
    OST_THEN(OST_NEW(ctx, &(*step)->product, n + 3 * (size_t)matrix->columns));
    OST_TRY_DONE(ost_agree(ctx, status));
    (*step)->matrix = matrix;
    (*step)->direction = (*step)->product + n;
done:
    if (status != OST_SUCCESS)
        ost_compensated_step_destroy(step);
    return status;
}

void ost_compensated_step_destroy(OstCompensatedStep **step)
{
    if (!*step)
        return;
    OST_FREE((*step)->product);
    OST_FREE(*step);
}

/* p = correction, made conjugate to the last p if there was one. */
static OstStatus next_direction(OstCompensatedStep *step, const double *correction)
{
    const size_t n = 3 * (size_t)step->matrix->rows;
    double overlap = 0.0;
    if (step->energy > 0.0)
        OST_TRY(ost_vector_dot(step->matrix->ctx, n, correction, step->product, &overlap));
    const double beta = step->energy > 0.0 ? overlap / step->energy : 0.0;
    for (size_t i = 0; i < n; i++)
        step->direction[i] = correction[i] - beta * step->direction[i];
    return OST_SUCCESS;
}

OstStatus ost_compensated_step_turn(OstCompensatedStep *step, const double *residual, double *correction)
{
    const size_t n = 3 * (size_t)step->matrix->rows;
    double gain;
    OST_TRY(next_direction(step, correction));
    memset(step->product, 0, n * sizeof *step->product);
    OST_TRY(ost_compensated_residual(step->matrix, step->product, step->direction, step->product));
    for (size_t i = 0; i < n; i++)
        step->product[i] = -step->product[i];
    OST_TRY(ost_vector_dot(step->matrix->ctx, n, step->direction, step->product, &step->energy));
    OST_TRY(ost_vector_dot(step->matrix->ctx, n, step->direction, residual, &gain));
    if (!(step->energy > 0.0 && isfinite(step->energy))) {
        step->energy = 0.0;
        step->length = 1.0;
        return OST_SUCCESS;
    }
    step->length = gain / step->energy;
    for (size_t i = 0; i < n; i++)
        correction[i] = step->length * step->direction[i];
    return OST_SUCCESS;
}

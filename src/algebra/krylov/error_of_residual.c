/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/error_of_residual.h"

#include "algebra/krylov/precondition.h"
#include "algebra/matrix/compensated_step.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>

enum { MOST_STEPS = 200 };

typedef struct Search {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    size_t n;                 /* unknowns this rank owns */
    double smallest;          /* eigenvalue of M^-1 A */
    double missing;           /* what may be missing of the error, relative to it */
    double *remaining;        /* r - A e, r being of order 1 */
    double *scaled;           /* the same in scaled unknowns */
    double *correction;       /* M^-1 of it, then the step */
    OstCompensatedStep *step; /* NULL if one application is enough */
    double weight;            /* remaining·M^-1 remaining */
    double gained;            /* |e|_A² */
} Search;

static OstStatus precondition(Search *search)
{
    OST_TRY(ost_precondition(search->system, search->preconditioner, search->remaining, search->scaled,
                             search->correction));
    return ost_vector_dot(search->system->matrix->ctx, search->n, search->remaining, search->correction,
                          &search->weight);
}

static void take_step(Search *search, double *error)
{
    const OstCompensatedStep *step = search->step;
    for (size_t i = 0; i < search->n; i++) {
        error[i] += search->correction[i];
        search->remaining[i] -= step->length * step->product[i];
    }
    search->gained += step->length * step->length * step->energy;
}

/* Does the next step, not yet taken, add less than is allowed to be missing? */
static OstStatus look_at_rest(const Search *search, const double *error, int *is_small)
{
    OstContext *ctx = search->system->matrix->ctx;
    double size, next;
    OST_TRY(ost_vector_dot(ctx, search->n, error, error, &size));
    OST_TRY(ost_vector_dot(ctx, search->n, search->correction, search->correction, &next));
    const double square = search->missing * search->missing;
    *is_small = search->weight <= square * search->smallest * search->gained && next <= square * size;
    return OST_SUCCESS;
}

static OstStatus iterate(Search *search, double *error, int *found)
{
    int is_small = 0;
    for (int k = 0;; k++) {
        OST_TRY(precondition(search));
        *found = search->weight >= 0.0 && isfinite(search->weight);
        if (!*found || search->weight == 0.0)
            return OST_SUCCESS;
        OST_TRY(look_at_rest(search, error, &is_small));
        if (is_small || k == MOST_STEPS)
            break;
        OST_TRY(ost_compensated_step_turn(search->step, search->remaining, search->correction));
        *found = search->step->energy > 0.0;
        if (!*found)
            return OST_SUCCESS;
        take_step(search, error);
    }
    const double enlarged = is_small ? 1.0 : sqrt(1.0 + search->weight / (search->smallest * search->gained));
    for (size_t i = 0; i < search->n; i++)
        error[i] *= enlarged;
    return OST_SUCCESS;
}

static OstStatus apply_once(Search *search, double *error, int *found)
{
    OST_TRY(precondition(search));
    *found = search->weight >= 0.0 && isfinite(search->weight);
    for (size_t i = 0; i < search->n; i++)
        error[i] = search->correction[i] / search->smallest;
    return OST_SUCCESS;
}

static OstStatus find(Search *search, const double *residual, double *error, int *found)
{
    OstContext *ctx = search->system->matrix->ctx;
    double size;
    OST_TRY(ost_vector_size(ctx, search->n, residual, &size));
    for (size_t i = 0; i < search->n; i++) {
        search->remaining[i] = residual[i] / size;
        error[i] = 0.0;
    }
    if (search->missing < 1.0)
        OST_TRY(ost_compensated_step_create(search->system->matrix, &search->step));
    OST_TRY(search->step ? iterate(search, error, found) : apply_once(search, error, found));
    for (size_t i = 0; i < search->n; i++)
        error[i] *= size;
    return OST_SUCCESS;
}

OstStatus ost_error_of_residual(const OstCgSystem *system, const OstPreconditioner *preconditioner, double smallest,
                                double missing, const double *residual, double *error, int *found)
{
    const OstBlockMatrix *matrix = system->matrix;
    Search search = {.system = system,
                     .preconditioner = preconditioner,
                     .n = 3 * (size_t)matrix->rows,
                     .smallest = smallest,
                     .missing = missing};
    OST_TRY(ost_agree(matrix->ctx, OST_NEW_UNCLEARED(matrix->ctx, &search.remaining, 3 * search.n)));
    search.scaled = search.remaining + search.n;
    search.correction = search.scaled + search.n;
    const OstStatus status = find(&search, residual, error, found);
    OST_FREE(search.remaining);
    ost_compensated_step_destroy(&search.step);
    return status;
}

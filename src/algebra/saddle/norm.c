/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/norm.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>

OstStatus ost_saddle_squares(const OstCoupling *coupling, const double *r_u, const double *r_p, double *q,
                             double *force, double squares[OST_SADDLE_SQUARES])
{
    const size_t n = 3 * (size_t)coupling->unknowns;
    OST_TRY(ost_coupling_transpose(coupling, q, force));
    squares[OST_SADDLE_FORCE] = ost_dot(n, r_u, r_u) + ost_dot(n, force, force);
    squares[OST_SADDLE_VOLUME] = ost_dot((size_t)coupling->rows, r_p, q);
    return ost_sum(coupling->ctx, OST_SADDLE_SQUARES, squares);
}

static OstStatus mean_diagonal(const OstBlockMatrix *matrix, double *mean)
{
    *mean = 0.0;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const double *block = ost_block_matrix_diagonal(matrix, row);
        *mean += block[0] + block[4] + block[8];
    }
    OST_TRY(ost_sum(matrix->ctx, 1, mean));
    *mean /= 3.0 * (double)matrix->global_rows;
    return OST_SUCCESS;
}

OstStatus ost_saddle_size(const OstBlockMatrix *matrix, const OstSaddle *saddle, const double *f, double *size)
{
    const OstCoupling *coupling = saddle->coupling;
    const size_t n = 3 * (size_t)coupling->unknowns, m = (size_t)coupling->rows, mg = (size_t)coupling->columns;
    double *memory = NULL, squares[OST_SADDLE_SQUARES], mean;
    OST_TRY(ost_agree(coupling->ctx, OST_NEW(coupling->ctx, &memory, n + mg + 3 * m)));
    OstStatus status = ost_coupling_schur_solve(coupling, NULL, saddle->g, memory + n, memory + n + mg);
    OST_THEN(ost_saddle_squares(coupling, f, saddle->g, memory + n, memory, squares));
    OST_THEN(mean_diagonal(matrix, &mean));
    if (status == OST_SUCCESS)
        *size = sqrt(squares[OST_SADDLE_FORCE] + mean * squares[OST_SADDLE_VOLUME]);
    OST_FREE(memory);
    return status;
}

OstStatus ost_saddle_goal(const OstBlockMatrix *matrix, const OstSaddle *saddle, const double *f, double relative,
                          OstGoal *goal)
{
    OST_TRY(ost_saddle_size(matrix, saddle, f, &goal->start));
    goal->norm = goal->start;
    goal->target = relative * goal->start;
    if (isfinite(goal->start))
        return OST_SUCCESS;
    return OST_RAISE(goal->ctx, OST_INVALID_INPUT, "the right-hand side holds a number that is not finite");
}

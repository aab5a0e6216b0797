/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_OPERATOR_H
#define ORTHOSTAT_ALGEBRA_METRIC_OPERATOR_H

#include "algebra/block_matrix.h"

/* A level's matrix (square blocks), or the prolongator from the next coarser level (height is this level's numbers per
 * node, width the coarser one's). Single precision halves the traffic of what is only a preconditioner; vectors are in
 * double precision. A vector over the columns has room for `columns` entries of `width` numbers, ghosts last. */
typedef struct OstMetricOperator {
    OstContext *ctx;
    int height, width; /* of a block: 3 or 6 */
    OstLocal rows;     /* block rows this rank owns */
    OstLocal columns;  /* block columns: owned and ghosts */
    OstLocal *row_start;
    OstLocal *column; /* ascending within a row */
    float *value;     /* row_start[rows] × height × width, each block column by column so that its rows vectorise */
    double *exact;    /* the same in double precision where that is kept (for the coarsest level's factor), or NULL */
    OstHalo *halo;    /* over columns */
    int borrows_halo;
} OstMetricOperator;

void ost_metric_operator_destroy(OstMetricOperator **op);

/* Collective. A copy of a block matrix, whose halo it borrows; `exact` keeps double precision as well. */
OstStatus ost_metric_operator_from_matrix(const OstBlockMatrix *matrix, int exact, OstMetricOperator **op);

/* Local. Fills `value` from `exact` and drops `exact` unless it is to be kept. */
OstStatus ost_metric_operator_round(OstMetricOperator *op, int exact);

/* Collective over neighbours. y += scale A x; the ghosts of x are filled here. */
OstStatus ost_metric_operator_add(const OstMetricOperator *op, double scale, double *x, double *y);

/* Collective over neighbours. y = Aᵀ x; y is over the columns, and right in its owned part. */
OstStatus ost_metric_operator_apply_transposed(const OstMetricOperator *op, const double *x, double *y);

/* Local. Where the block of (row, column) is, or -1. */
OstLocal ost_metric_operator_find(const OstMetricOperator *op, OstLocal row, OstLocal column);

/* Local. Puts 1 on the diagonal of a square matrix where it is not positive, so that an unknown that the prolongator
 * does not reach (a mode its aggregate cannot show) does no harm. */
void ost_metric_operator_mend_diagonal(OstMetricOperator *op);

#endif

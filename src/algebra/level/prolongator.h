/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_PROLONGATOR_H
#define ORTHOSTAT_ALGEBRA_LEVEL_PROLONGATOR_H

#include "algebra/level/simd.h"
#include "algebra/trilinos/exchange.h"

/* The prolongator P from a coarse level to the next finer one, in single precision or, with a rest, in twice that.
 * Columns are coarse nodes: this
 * rank's, then those of other ranks in its rows, by ascending global number. */
typedef struct OstProlongator {
    OstContext *ctx;
    int height; /* unknowns of a fine node: 3 or 6; a coarse node has OST_MODES */
    OstLocal rows, columns;
    OstLocal *row_start, *column; /* columns ascend within a row, until the coarse level is gathered on fewer ranks */
    float *value;                 /* row_start[rows] × height × OST_MODES, row by row, and padding */
    float *rest;                  /* as value: what rounding took from it; or NULL */
    OstHalo *halo;                /* over columns */
    OstExchange *exchange;        /* of coarse vectors along that halo */
} OstProlongator;

void ost_prolongator_destroy(OstProlongator **prolongator);

/* Collective over neighbours. x += P c; the ghosts of c are filled here. Both are level vectors. */
void ost_prolongator_add(const OstProlongator *prolongator, double *c, double *x);

/* Collective over neighbours. c = Pᵀ x; c has room for all columns; its owned part is the result. */
void ost_prolongator_restrict(const OstProlongator *prolongator, const double *x, double *c);

#endif

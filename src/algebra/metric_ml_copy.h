/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_ML_COPY_H
#define ORTHOSTAT_ALGEBRA_METRIC_ML_COPY_H

#include "algebra/metric_operator.h"

#include <ml_include.h>

/* Collective. Copies an operator of ML into blocks of height × width with a halo of whole nodes; ML has scalar rows and
 * its own numbers for ghosts. `exact` keeps double precision as well. */
OstStatus ost_metric_operator_from_ml(OstContext *ctx, ML_Operator *source, int height, int width, int exact,
                                      OstMetricOperator **op);

#endif

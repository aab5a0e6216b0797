/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_SMOOTHING_H
#define ORTHOSTAT_ALGEBRA_METRIC_SMOOTHING_H

#include "algebra/metric_matrix.h"
#include "algebra/metric_prolongator.h"
#include "algebra/metric_tentative.h"

/* Collective. One step of damped Jacobi on the tentative prolongator: P = (I - omega D^-1 A) T, D the diagonal of A and
 * omega 4/3 over the largest eigenvalue of D^-1 A (Vaněk, Mandel, Brezina 1996). `rounded` is the same A. */
OstStatus ost_tentative_smooth(const OstTentative *tentative, const OstExactMatrix *matrix,
                               const OstLevelMatrix *rounded, OstProlongator **prolongator);

#endif

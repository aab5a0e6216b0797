/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_PROLONGATOR_SMOOTHING_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_PROLONGATOR_SMOOTHING_H

#include "algebra/level/level_matrix.h"
#include "algebra/level/prolongator.h"
#include "algebra/level/tentative.h"
#include "algebra/multigrid/smoother.h"

/* Collective. One step of damped block Jacobi on the tentative prolongator T: P = (I - omega B^-1 A) T, where B is the
 * smoother's blocks and omega = 4/3 over the largest eigenvalue of B^-1 A (Vaněk, Mandel, Brezina 1996, but with
 * blocks).
 */
OstStatus ost_tentative_smooth(const OstTentative *tentative, const OstDoubleMatrix *matrix,
                               const OstSmoother *smoother, OstProlongator **prolongator);

/* Collective. The tentative prolongator as it is. */
OstStatus ost_tentative_keep(const OstTentative *tentative, const OstDoubleMatrix *matrix,
                             OstProlongator **prolongator);

#endif

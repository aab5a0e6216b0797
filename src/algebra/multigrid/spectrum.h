/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_SPECTRUM_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_SPECTRUM_H

#include "algebra/level/level_matrix.h"

/* Local. z = M^-1 r for a symmetric positive definite M that couples only unknowns of this rank. */
typedef void (*OstLocalSolve)(const void *data, const double *r, double *z);

/* Collective. Estimates the largest eigenvalue of M^-1 A, from below, by ten Lanczos steps from a random vector. */
OstStatus ost_largest_eigenvalue(const OstLevelMatrix *a, OstLocalSolve solve, const void *data, double *largest);

#endif

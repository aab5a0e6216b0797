/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_SPECTRUM_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_SPECTRUM_H

#include "algebra/level/level_matrix.h"

/* z = M^-1 r for a symmetric positive definite M of this rank's unknowns alone. */
typedef void (*OstLocalSolve)(const void *data, const double *r, double *z);

/* Collective. The largest eigenvalue of M^-1 A, from below, by Lanczos' method from a vector that looks like noise. */
OstStatus ost_largest_eigenvalue(const OstLevelMatrix *a, OstLocalSolve solve, const void *data, double *largest);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_COARSE_PARENTS_H
#define ORTHOSTAT_PROBLEM_COARSE_PARENTS_H

#include "assembly/system.h"

/* Local. Interpolation of a quadratic system's rows from a linear one of the same tets: for each row four columns of
 * the linear matrix (-1: none, or constrained) and their weights. A node on a straight edge takes the mean of the
 * edge's ends. One on a curved edge lies off that mean, and is interpolated (or extrapolated) in a tet at the edge, so
 * that rotations and uniform strains of the body are reproduced. Both arrays, 4 × rows, are the caller's. */
OstStatus ost_coarse_parents(const OstSystem *quadratic, const OstSystem *linear, OstLocal **parents, double **weights);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_COARSE_PARENTS_H
#define ORTHOSTAT_PROBLEM_COARSE_PARENTS_H

#include "assembly/system.h"

/* Local. How a quadratic system's rows follow from a linear one of the same tets: for each row four columns of the
 * linear matrix (-1: none, or held) and their weights. A node on a straight edge takes the mean of the edge's ends; one
 * on a curved edge lies off that mean, and takes what a tet at the edge has where the node is, inside or not, so that
 * rotations and uniform strains of the body are shown as they are. Both arrays, 4 × rows, are the caller's. */
OstStatus ost_coarse_parents(const OstSystem *quadratic, const OstSystem *linear, OstLocal **parents, double **weights);

#endif

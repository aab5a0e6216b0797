/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_TENTATIVE_H
#define ORTHOSTAT_ALGEBRA_LEVEL_TENTATIVE_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/double_matrix.h"
#include "algebra/level/simd.h"

/* The tentative prolongator: the near-null space restricted to an aggregate, made orthonormal, is the basis of its
 * coarse node. Ghost nodes are included. */
typedef struct OstTentative {
    OstContext *ctx;
    OstLocal coarse_nodes;  /* of this rank */
    OstGlobal first_coarse; /* global number of the first */
    OstGlobal *coarse;      /* fine columns: global number of each node's coarse node, or -1 */
    float *block;  /* fine columns: each node's rows of the basis, size × OST_MODES; then OST_PADDING of padding */
    float *rest;   /* rows: what single precision leaves of `block`, or NULL */
    double *modes; /* near-null space of the coarse level: OST_MODES columns of OST_MODES × coarse_nodes */
} OstTentative;

/* Collective. `modes`: near-null space of the fine level, OST_MODES columns of size × rows. A mode that is
 * linearly dependent on an aggregate gets a basis vector of zeros, and the coarse modes are 0 there. `precise`: is the
 * rest kept? */
OstStatus ost_tentative_create(const OstDoubleMatrix *matrix, const OstAggregates *aggregates, const double *modes,
                               int precise, OstTentative **tentative);
void ost_tentative_destroy(OstTentative **tentative);

#endif

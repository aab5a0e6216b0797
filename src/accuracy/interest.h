/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_INTEREST_H
#define ORTHOSTAT_ACCURACY_INTEREST_H

#include "problem/problem.h"

/* A quantity of interest as a linear function of the displacement about u: what its adjoint problem is made of. */
typedef struct OstInterest {
    double *load; /* 3 × owned_nodes: by how much a displacement grows with each node's; of a moment's arms, where
                     rotations are large, by how much less it does; or NULL */
    double
        *moved; /* of a reaction: 3 × node_count, a displacement that is 1 along the reaction at its nodes; or NULL */
    double direction[3]; /* of a reaction: along it, or along the axis of its moment */
    double value;
} OstInterest;

/* Collective. Makes that of a watched displacement or reaction. A length is taken along the vector as it is, or along x
 * if that is zero. Clear it also after a failure. */
OstStatus ost_interest_create(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                              OstInterest *interest);
void ost_interest_clear(OstInterest *interest);

#endif

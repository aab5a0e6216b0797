/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_COLUMNS_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_COLUMNS_H

#include "algebra/aggregation/graph.h"

/* Collective. The columns of nodes through the thickness of a plate: each node joins those that are far nearer to it
 * than its other neighbours. In space first, as what bends is thin whatever it is made of; else in the material metric,
 * as a body that is 1e6 times stiffer in one direction bends as one that is 32 times thinner there. *columns is NULL if
 * the body is not made of columns of three nodes or more. */
OstStatus ost_columns_create(const OstMetricGraph *graph, OstAggregates **columns);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_GATHERED_LEVEL_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_GATHERED_LEVEL_H

#include "algebra/aggregation/graph.h"
#include "algebra/level/double_matrix.h"
#include "algebra/level/prolongator.h"

/* A coarse level on fewer ranks. Where its ranks have few nodes each, messages take longer than arithmetic, and
 * aggregates, which do not cross ranks, could not shrink it any more: groups of neighbouring ranks hand their nodes to
 * the first rank of the group, and the others have none. Global numbers stay. */

/* A rank has at least about so many, where the level has: on so many, arithmetic takes about as long as the messages to
 * twenty neighbours at 2 µs each. */
enum { OST_NODES_OF_RANK = 24 };

/* Local. Every how manyth rank has nodes of a level of so many, if it is every `stride`th of the level above; all of
 * them are on rank 0 if `together`. */
int ost_gathered_stride(OstGlobal nodes, int ranks, int stride, int together);

/* What there is of a level while the next one is not made: all are replaced. */
typedef struct OstLooseLevel {
    OstDoubleMatrix **matrix;
    OstMetricGraph **graph;
    double **modes;              /* OST_MODES columns of OST_MODES × rows */
    OstProlongator *prolongator; /* to the level above: its columns are numbered anew */
    OstGlobal first;             /* global number of this rank's first node */
} OstLooseLevel;

/* Collective. Moves the nodes to every `stride`th rank. */
OstStatus ost_level_gather(OstLooseLevel *level, int stride);

#endif

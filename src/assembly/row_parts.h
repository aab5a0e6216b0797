/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_ROW_PARTS_H
#define ORTHOSTAT_ASSEMBLY_ROW_PARTS_H

#include "assembly/system.h"

/* What a node's displacement is made of where nodes follow others: rows, by numbers over all ranks, and 3×3 weights. */
typedef struct OstRowParts {
    int count;
    OstGlobal row[OST_MOST_LEADERS]; /* -1: none, all of it is prescribed */
    const double *weight[OST_MOST_LEADERS];
} OstRowParts;

/* The rows of local nodes, and of those that they follow. */
typedef struct OstRowNumbers {
    const OstLinks *links;
    OstGlobal *of_node;   /* node_count: of nodes that follow nobody, -1 for others */
    OstGlobal *of_leader; /* links->slots */
} OstRowNumbers;

/* Collective. Of a system whose rows are numbered, and whose supports have links. */
OstStatus ost_row_numbers_create(const OstSystem *system, OstRowNumbers *numbers);
void ost_row_numbers_clear(OstRowNumbers *numbers);

/* Local. A node that follows nobody has its own row, at the weight 1: its support is left to the caller. The weights of
 * others have their leaders' supports. */
void ost_row_parts(const OstRowNumbers *numbers, OstLocal node, OstRowParts *parts);

#endif

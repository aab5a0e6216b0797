/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LINKS_ROW_PARTS_H
#define ORTHOSTAT_ASSEMBLY_LINKS_ROW_PARTS_H

#include "assembly/links/links.h"

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

/* Collective. `row_of_node`: this rank's row of each owned node, or -1; `first_row`: the number of its first. */
OstStatus ost_row_numbers_create(const OstLinks *links, const OstLocal *row_of_node, OstGlobal first_row,
                                 OstRowNumbers *numbers);
void ost_row_numbers_clear(OstRowNumbers *numbers);

/* Local. A node that follows nobody has its own row, at the weight 1: its support is left to the caller. The weights of
 * others have their leaders' supports. */
void ost_row_parts(const OstRowNumbers *numbers, OstLocal node, OstRowParts *parts);

#endif

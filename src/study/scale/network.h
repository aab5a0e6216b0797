/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_SCALE_NETWORK_H
#define ORTHOSTAT_STUDY_SCALE_NETWORK_H

#include "orthostat/context.h"

enum { OST_NETWORK_NAME = 32 };

/* What a machine's nodes and its network can do. */
typedef struct OstNetwork {
    char name[OST_NETWORK_NAME];
    double latency;   /* seconds of a short message */
    double bandwidth; /* bytes a second that leave a node, all its ranks together */
    double memory;    /* bytes a second that a node's ranks read from its memory, all together */
    double ranks;     /* of a node */
} OstNetwork;

/* Local. Reads a known name, or "latency=2e-6,bandwidth=25e9,memory=200e9,ranks=64", of which what is left out is as in
 * the first known one. Returns 0 if the text is neither. */
int ost_network_parse(const char *text, OstNetwork *network);

/* Local. The known names, with commas between them. */
const char *ost_network_names(void);

/* Collective. Latency and bandwidth between rank 0 and each of the next few, by messages to and fro; zeros on one rank.
 * `ranks` is filled too, `memory` is not. */
OstStatus ost_network_measure(OstContext *ctx, OstNetwork *network);

/* Collective. The cores that the ranks of a machine may use, and the ranks on it: of the machine with the most ranks a
 * core. */
OstStatus ost_network_cores(OstContext *ctx, int *cores, int *ranks);

#endif

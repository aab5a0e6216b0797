/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_HALO_H
#define ORTHOSTAT_CORE_PARALLEL_HALO_H

#include "orthostat/context.h"

/* The largest entry that a halo carries, in bytes. Its messages are checked and its buffer is had when it is made, so
 * that no exchange can fail on one rank alone and leave the others waiting. */
enum { OST_LARGEST_ENTRY = 288 };

/* Who needs which of my entries, and whose entries I hold copies of. A distributed array has `owned` entries followed
 * by `ghosts` copies, the copies grouped by the rank that owns them; an entry is `width` numbers. */
typedef struct OstHalo {
    OstContext *ctx;
    OstLocal owned;
    OstLocal ghosts;
    int neighbour_count;
    int *neighbour;          /* ranks, ascending */
    OstLocal *send_start;    /* neighbour_count + 1 */
    OstLocal *send_index;    /* owned entries that neighbour k holds copies of: send_index[send_start[k] .. ] */
    OstLocal *receive_start; /* neighbour_count + 1; copies from neighbour k: owned + receive_start[k] .. */
    void *buffer;            /* outgoing or incoming messages of the largest entries */
    MPI_Request *request;
} OstHalo;

/* Collective. Builds the halo of `owned` entries with the global numbers first_number .. first_number + owned - 1
 * (contiguous over ranks) and of `ghosts` copies with the given global numbers, which must be grouped by ascending
 * owner. Raises OST_INVALID_INPUT if a number belongs to nobody or to this rank. */
OstStatus ost_halo_create(OstContext *ctx, OstLocal owned, OstGlobal first_number, OstLocal ghosts,
                          const OstGlobal *ghost_number, OstHalo **halo);
void ost_halo_destroy(OstHalo **halo);

/* Collective. The halo of the entries with renumber[i] >= 0 (i over owned then ghosts; kept entries must be numbered
 * in their old order, owned first); the flags must agree between a ghost and its owner. */
OstStatus ost_halo_subset(const OstHalo *halo, const OstLocal *renumber, OstHalo **subset);

/* Collective over neighbours. Copies owners' values into the ghosts; `size` is the bytes of an entry. */
OstStatus ost_halo_import(OstHalo *halo, size_t size, void *values);

/* Collective over neighbours. Adds the ghosts' values to their owners' (width doubles an entry); ghosts keep theirs. */
OstStatus ost_halo_add_to_owners(OstHalo *halo, int width, double *values);

#endif

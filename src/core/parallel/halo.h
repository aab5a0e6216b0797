/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_HALO_H
#define ORTHOSTAT_CORE_PARALLEL_HALO_H

#include "orthostat/context.h"

/* The largest entry that a halo exchanges, in bytes. The messages are checked and the buffer is allocated when the halo
 * is made, so that no exchange can fail on one rank alone and leave the others waiting. */
enum { OST_LARGEST_ENTRY = 288 };

/* The exchange of ghosts of a distributed array: which ranks have ghosts of this rank's entries, and which ranks own
 * its ghosts. The array has `owned` entries followed by `ghosts` copies, grouped by the rank that owns them. */
typedef struct OstHalo {
    OstContext *ctx;
    OstLocal owned;
    OstLocal ghosts;
    int neighbour_count;
    int *neighbour;          /* ranks, ascending */
    OstLocal *send_start;    /* neighbour_count + 1 */
    OstLocal *send_index;    /* owned entries that are ghosts on neighbour k: send_index[send_start[k] .. ] */
    OstLocal *receive_start; /* neighbour_count + 1; ghosts from neighbour k: owned + receive_start[k] .. */
    void *buffer;            /* for all messages one way, of the largest entries */
    MPI_Request *request;
} OstHalo;

/* Collective. The halo of `owned` entries with the global numbers first_number .. first_number + owned - 1 (contiguous
 * over ranks) and of `ghosts` with the given global numbers, grouped by ascending owner. Raises OST_INVALID_INPUT if a
 * ghost's number belongs to no rank or to this one. */
OstStatus ost_halo_create(OstContext *ctx, OstLocal owned, OstGlobal first_number, OstLocal ghosts,
                          const OstGlobal *ghost_number, OstHalo **halo);
void ost_halo_destroy(OstHalo **halo);

/* Local. The halo of the entries with renumber[i] >= 0 (i over owned entries, then ghosts), their new numbers.
 * They must keep their order; a ghost must be in if and only if its owner's entry is. */
OstStatus ost_halo_subset(const OstHalo *halo, const OstLocal *renumber, OstHalo **subset);

/* Local. How many neighbours have entries by `start` (send_start or receive_start): the messages of an exchange. */
int ost_halo_messages(const OstHalo *halo, const OstLocal *start);

/* Collective over neighbours. Copies owners' values into the ghosts; `size` is the bytes of an entry. */
OstStatus ost_halo_import(OstHalo *halo, size_t size, void *values);

/* Collective over neighbours. Adds the ghosts' values to their owners' (`width` doubles per entry); the ghosts' own
 * values stay. */
OstStatus ost_halo_add_to_owners(OstHalo *halo, int width, double *values);

/* Collective over neighbours. Likewise the largest of an owner's value and its ghosts'. */
OstStatus ost_halo_max_at_owners(OstHalo *halo, int width, double *values);

#endif

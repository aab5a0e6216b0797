/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_REHEARSAL_H
#define ORTHOSTAT_FORMATS_VTKHDF_REHEARSAL_H

#include "orthostat/context.h"

/* Reads a file; must not speak to other ranks. */
typedef OstStatus OstReading(OstContext *ctx, const char *path);

/* Local. HDF5 trusts what a file says of itself: a damaged one makes it take gigabytes, run without end, or crash. So
 * `read` first runs in a process of its own, within a second of processor time (and one more for each 10 MiB, which may
 * be packed) and ten times the file's memory. Where it does not come back in good order this raises OST_FILE_FAILED;
 * what it returns is for the real reading to find again. */
OstStatus ost_hdf5_rehearse(OstContext *ctx, const char *path, OstReading *read);

/* Local. The rehearsal itself, for a process that may be lost: returns if the file is one to read, else the process
 * ends, with exit status 1 if it was memory that HDF5 asked too much of. Limits stay as they were set. */
void ost_hdf5_rehearse_here(OstContext *ctx, const char *path, OstReading *read);

/* Local. Raises OST_FILE_FAILED for a process that ended in a rehearsal; `how` is waitpid's. */
OstStatus ost_hdf5_raise_lost(OstContext *ctx, const char *path, int how);

#endif

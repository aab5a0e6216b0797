/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_DRY_RUN_H
#define ORTHOSTAT_FORMATS_VTKHDF_DRY_RUN_H

#include "orthostat/context.h"

/* Reads a file, without communication; `name` as the dry run was given it. */
typedef OstStatus OstReading(OstContext *ctx, const char *path, const char *name);

/* Local. HDF5 trusts what a file says of itself: a damaged one makes it take gigabytes, run without end, or crash. So
 * `read` first runs in a process of its own, limited to one second of processor time (and one more for each 10 MiB,
 * which may be compressed) and to ten times the file's memory. Raises OST_FILE_FAILED if that process does not end
 * normally. `name` goes to `read`. An error that `read` returns is ignored: the real reading finds it again. */
OstStatus ost_hdf5_dry_run(OstContext *ctx, const char *path, OstReading *read, const char *name);

/* Local. The dry run itself, for a process that may be lost. Returns if the file can be read or is refused in good
 * order; otherwise the process ends, with exit status 1 if HDF5 asked for too much memory. The limits stay set. */
void ost_hdf5_dry_run_here(OstContext *ctx, const char *path, OstReading *read, const char *name);

/* Local. Raises OST_FILE_FAILED for a process that a dry run ended; `how` is waitpid's status. */
OstStatus ost_hdf5_raise_lost(OstContext *ctx, const char *path, int how);

#endif

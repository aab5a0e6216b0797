/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_REHEARSAL_H
#define ORTHOSTAT_FORMATS_VTKHDF_REHEARSAL_H

#include "orthostat/context.h"

/* Local. HDF5 trusts what a file says of itself: a damaged one makes it take gigabytes, run without end, or crash. So
 * `read`, which must not speak to other ranks, first runs in a process of its own, within a second of processor time
 * (and one more for each 100 MiB) and ten times the file's memory. Where it does not come back in good order this
 * raises OST_FILE_FAILED; what it returns is for the real reading to find again. */
OstStatus ost_hdf5_rehearse(OstContext *ctx, const char *path, OstStatus (*read)(OstContext *ctx, const char *path));

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_DISK_SPACE_H
#define ORTHOSTAT_FORMATS_VTKHDF_DISK_SPACE_H

#include "core/write_aside.h"

/* Collective. Is there room on disk for this many bytes (as rank 0 gives them)? Asks the file system to reserve them,
 * which respects quotas and limits too, and empties the file again. Needed because Open MPI 4.1 does not report a full
 * disk: the written file has holes, and HDF5 takes it for whole, or crashes as it closes it. A file system that cannot
 * reserve space is trusted. Raises OST_FILE_FAILED with the size and the system's reason. */
OstStatus ost_disk_space_check(OstContext *ctx, const OstAside *file, OstGlobal bytes);

/* Collective. The same, but the space stays reserved while the file is written, so that no other program takes it. The
 * file then has this size; HDF5 truncates it when it closes it. */
OstStatus ost_disk_space_keep(OstContext *ctx, const OstAside *file, OstGlobal bytes);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_DISK_SPACE_H
#define ORTHOSTAT_FORMATS_DISK_SPACE_H

#include "orthostat/context.h"

/* Collective. Would a file of this name and size (as rank 0 gives it) find room? The file system is asked to set the
 * room aside, which minds quotas and limits too; then the file is removed, whatever it was. Open MPI 4.1 does not pass
 * on that a disk is full: what is written has holes, and HDF5 takes it for whole, or crashes as it closes it. A file
 * system that cannot set room aside is trusted. Raises OST_FILE_FAILED with the size and what the system says. */
OstStatus ost_disk_space_check(OstContext *ctx, const char *path, OstGlobal bytes);

/* Collective. The same for a file that is there and stays: the room is its own while it is written, whoever else fills
 * the disk. It has this size then; HDF5 cuts what it does not use when it closes the file. */
OstStatus ost_disk_space_keep(OstContext *ctx, const char *path, OstGlobal bytes);

#endif

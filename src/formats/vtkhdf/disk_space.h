/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_DISK_SPACE_H
#define ORTHOSTAT_FORMATS_VTKHDF_DISK_SPACE_H

#include "core/write_aside.h"

/* Collective. Would this many bytes (as rank 0 gives them) find room in the file? The file system is asked to reserve
 * them, which minds quotas and limits too; then the file is empty again. Open MPI 4.1 does not report a full disk: what
 * is written has holes, and HDF5 takes it for whole, or crashes as it closes it. A file system that cannot reserve
 * space is trusted. Raises OST_FILE_FAILED with the size and what the system says. */
OstStatus ost_disk_space_check(OstContext *ctx, const OstAside *file, OstGlobal bytes);

/* Collective. The same, and the space stays reserved while the file is written, whoever else fills the disk. The file
 * has this size then; HDF5 cuts off what it does not use when it closes the file. */
OstStatus ost_disk_space_keep(OstContext *ctx, const OstAside *file, OstGlobal bytes);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_ADDRESS_SPACE_H
#define ORTHOSTAT_CORE_ADDRESS_SPACE_H

#include <stddef.h>

/* Local. Could the process map so many MiB more? Not if a limit (ulimit -v) is in the way. */
int ost_address_space_has(size_t mebibytes);

/* Local. OpenBLAS takes a buffer of 128 MiB when it is first called, keeps it, and asks for ever where it gets none:
 * this makes it take the buffer at once. Returns 0 if there is no room. */
int ost_start_blas(void);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* HDF5 keeps lists of free blocks, and makes nodes, one for each group, as large as 16-bit numbers in the head of the
 * file say; a dry run allows as much. */
const FuzzTarget fuzz_target = {.file = "mesh.vtkhdf", .read = read_mesh, .constant = 64 << 20, .library_caches = 1};

/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* HDF5 keeps lists of free blocks, and a cache of metadata and chunks while a file is open. */
const FuzzTarget fuzz_target = {.file = "mesh.vtkhdf", .read = read_mesh, .constant = 4 << 20, .library_caches = 1};

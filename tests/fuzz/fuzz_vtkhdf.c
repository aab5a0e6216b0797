/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* HDF5 keeps lists of free blocks, and makes nodes as large as 16-bit numbers in the head of the file say. */
const FuzzTarget fuzz_target = {.file = "mesh.vtkhdf", .read = read_mesh, .constant = 32 << 20, .library_caches = 1};

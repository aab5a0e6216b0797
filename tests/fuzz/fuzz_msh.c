/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* Gmsh keeps tables of its element types. */
const FuzzTarget fuzz_target = {.file = "mesh.msh", .read = read_mesh, .constant = 4 << 20, .library_caches = 1};

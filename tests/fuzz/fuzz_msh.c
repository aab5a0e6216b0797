/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* A packed file may unpack to fifty times its size. */
const FuzzTarget fuzz_target = {.file = "mesh.msh", .read = read_mesh, .constant = 16 << 20};

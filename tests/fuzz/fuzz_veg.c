/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

const FuzzTarget fuzz_target = {.file = "mesh.veg", .read = read_mesh, .constant = 256 << 10};

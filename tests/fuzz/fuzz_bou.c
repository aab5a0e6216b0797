/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/memory.h"
#include "formats/serial/formats.h"
#include "fuzz.h"

/* A list of vertices. */
static void read_vertices(OstContext *ctx, const char *path)
{
    OstGlobal count = 0;
    OstLabelRange *ranges = NULL;
    ost_vertex_list_read(ctx, path, &count, &ranges);
    OST_FREE(ranges);
}

const FuzzTarget fuzz_target = {.file = "vertices.bou", .read = read_vertices, .constant = 256 << 10};

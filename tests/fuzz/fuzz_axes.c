/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/formats.h"
#include "fuzz.h"

enum { NUMBERS = 9, TETS = 4 };

/* Axes of a mesh of four tets. */
static void read_axes(OstContext *ctx, const char *path)
{
    static const OstGlobal labels[TETS] = {4, 1, 2, 3};
    double axes[TETS * NUMBERS];
    ost_table_read(ctx, path, NUMBERS, TETS, TETS, labels, axes);
}

const FuzzTarget fuzz_target = {.file = "axes.txt", .read = read_axes, .constant = 256 << 10};

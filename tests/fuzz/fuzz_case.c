/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_data.h"
#include "fuzz.h"

/* The case file. */
static void read_case(OstContext *ctx, const char *path)
{
    OstCase *c = NULL;
    ost_case_read(ctx, path, &c);
    ost_case_destroy(&c);
}

const FuzzTarget fuzz_target = {.file = "case.yaml", .read = read_case, .constant = 256 << 10};

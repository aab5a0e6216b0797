/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_VERIFY_HARD_H
#define ORTHOSTAT_CLI_VERIFY_HARD_H

#include "orthostat/context.h"

/* What `orthostat verify --hard` was asked for. */
typedef struct OstHardArguments {
    int quick;
    const char *json;    /* or NULL */
    const char *picture; /* a folder, or NULL */
    int shape_count;     /* 0: all */
    const char *const *shape;
} OstHardArguments;

/* Collective. Runs the hard grid, prints it, and writes and draws what was asked for. */
OstStatus ost_cli_verify_hard(OstContext *ctx, const OstHardArguments *arguments, int *passed);

#endif

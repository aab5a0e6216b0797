/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_FUZZ_FUZZ_H
#define ORTHOSTAT_TESTS_FUZZ_FUZZ_H

#include "orthostat/context.h"

#include <stddef.h>
#include <stdint.h>

/* A reader that is fuzzed: each fuzz_x.c defines its own. It is given one file after another and must refuse or read
 * each without a crash, within a second of processor time, with memory of at most ten times the file and a constant,
 * and must free all of it. Any of these broken ends the program by abort(), as a fault found by a sanitizer does. */
typedef struct FuzzTarget {
    const char *file; /* what the input is called; readers look at the ending */
    void (*read)(OstContext *ctx, const char *path);
    size_t (*write)(const uint8_t *data, size_t size, const char *path); /* makes the file, unless it is the input;
                                                                            returns its size */
    size_t constant;    /* bytes that the libraries behind it take whatever they read */
    int library_caches; /* they keep some of it for the next file */
} FuzzTarget;

extern const FuzzTarget fuzz_target;

/* The entry points of libFuzzer; replay.c calls them too. */
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Allowances of one input. start opens them, end aborts with a message if memory was over them or is left allocated;
 * processor time over them aborts at once. Memory is counted by the sanitizer where there is one (every allocation of
 * the program and its libraries), else by the ledger (our own). */
void fuzz_limits_start(OstContext *ctx);
void fuzz_limits_end(OstContext *ctx, size_t input_bytes);

#endif

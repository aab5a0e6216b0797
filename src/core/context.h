/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_CONTEXT_H
#define ORTHOSTAT_CORE_CONTEXT_H

#include "orthostat/context.h"

enum { OST_ERROR_ORIGIN_SIZE = 256, OST_LEDGER_DEPTH = 32 };

/* How far something is, from `first` at `start` on; a fraction below 0: not known. */
typedef struct OstProgress {
    char what[96];
    double fraction, first, start;
} OstProgress;

/* Parts of a task that are done at the same time, from `first` on: since `start`, in as many seconds as foretold. */
typedef struct OstProgressBatch {
    int first, count;
    double start, seconds;
} OstProgressBatch;

/* A context's fields; only core/ reads them. */
struct OstContext {
    MPI_Comm comm;
    int rank;
    int size;
    OstLogLevel level;
    void (*hear)(void *listener, const char *text);
    void *listener;
    char **warning;
    int warnings;
    double expected;         /* seconds of the whole, as foretold; 0: not known */
    OstProgress task, phase; /* of the whole, of which a name may be missing; and what is done now */
    int task_done, task_count;
    double expected_once, expected_each; /* seconds of a batch: what its parts share, and each of them */
    OstProgressBatch batch;
    char error_text[OST_ERROR_TEXT_SIZE];
    char error_origin[OST_ERROR_ORIGIN_SIZE];

    OstLedgerEntry ledger[OST_LEDGER_ACCOUNTS];
    const char *label[OST_LEDGER_ACCOUNTS];
    OstWork level_work[OST_LEDGER_LEVELS + 1]; /* the first is that of no level */
    int work_level;                            /* 1 + the level, or 0 */
    OstAccount stack[OST_LEDGER_DEPTH];
    int depth;
    double clock;                 /* until when seconds are booked */
    struct OstTogether *together; /* whose task is running (core/together/); NULL: none */
    double elsewhere;             /* seconds in which that task waited */
    size_t bytes;
    size_t peak_bytes;
};

/* Names the phases and starts the clock. */
void ost_ledger_open(OstContext *ctx);

/* Books `bytes` more (or, with `freed`, fewer) to an account. */
void ost_ledger_book(OstContext *ctx, OstAccount account, size_t bytes, int freed);

/* Local. Frees the warnings that are kept (ost_warning). */
void ost_forget_warnings(OstContext *ctx);

#endif

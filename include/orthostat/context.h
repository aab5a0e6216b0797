/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CONTEXT_H
#define ORTHOSTAT_CONTEXT_H

#include "orthostat/ledger.h"
#include "orthostat/status.h"

#include <mpi.h>
#include <stdint.h>

OST_API_BEGIN

/* Numbers local to a rank, and numbers over the whole body. */
typedef int32_t OstLocal;
typedef int64_t OstGlobal;

/* Carries the communicator, the error text, the log and the ledger; first argument of every fallible function. */
typedef struct OstContext OstContext;

typedef enum { OST_LOG_QUIET, OST_LOG_NORMAL, OST_LOG_VERBOSE } OstLogLevel;

/* Collective. Duplicates `comm` (MPI must be initialised); free with ost_context_destroy, which nulls the pointer.
 * Returns OST_LIBRARY_FAILED if MPI does, OST_OUT_OF_MEMORY. */
OstStatus ost_context_create(MPI_Comm comm, OstContext **ctx);
void ost_context_destroy(OstContext **ctx);

/* Collective. The same for callers in other languages, who have no MPI_Comm to pass: of the communicator that Fortran
 * knows by this number (MPI_Comm_c2f; mpi4py: comm.py2f()); and on all processes, MPI being started if nobody has done
 * so yet. */
OstStatus ost_context_create_by_number(int comm, OstContext **ctx);
OstStatus ost_context_create_on_all(OstContext **ctx);

/* Collective. Ends MPI if ost_context_create_on_all started it and it still runs; contexts are destroyed before. */
void ost_end_mpi(void);

/* Local. The communicator, this process's rank in it, and the number of ranks. */
MPI_Comm ost_comm(const OstContext *ctx);
int ost_rank(const OstContext *ctx);
int ost_size(const OstContext *ctx);

/* The most that a text of failure holds, with its end. */
enum { OST_ERROR_TEXT_SIZE = 4096 };

/* Local. Text of the last failure ("" if none) and the source line that raised it. */
const char *ost_error_text(const OstContext *ctx);
const char *ost_error_origin(const OstContext *ctx);

/* Collective. Every rank passes its own status; all return the one of the lowest rank that failed, with its text. */
OstStatus ost_agree(OstContext *ctx, OstStatus status);

/* Collective. Gives every rank the items of all ranks (`count` here, of `size` bytes), in the order of ranks: *total
 * items in *all, which the caller frees by ost_free_memory. Raises OST_LIMIT_EXCEEDED if there are more than 2^31 - 1.
 */
OstStatus ost_gather(OstContext *ctx, size_t size, const void *items, OstLocal count, void **all, OstLocal *total);

/* Local; rank 0 prints to standard error, the others are silent. Progress shows where the
 * program asks for it (core/progress.h); fraction in [0, 1], or negative where it is done. A task is made of phases. */
void ost_log_set_level(OstContext *ctx, OstLogLevel level);
OstLogLevel ost_log_level(const OstContext *ctx);
void ost_log(OstContext *ctx, OstLogLevel level, const char *format, ...) __attribute__((format(printf, 3, 4)));
void ost_warn(OstContext *ctx, const char *format, ...) __attribute__((format(printf, 2, 3)));
void ost_progress(OstContext *ctx, const char *what, double fraction);
void ost_progress_task(OstContext *ctx, const char *what, int done, int count);

/* Local. Hands every warning of rank 0 to `hear` too, quiet or not; NULL ends it. */
void ost_warn_listen(OstContext *ctx, void (*hear)(void *listener, const char *text), void *listener);

/* Local. The warnings of rank 0 so far, quiet or not, each text once: how many, and one of them, which lives as long as
 * the context. */
int ost_warning_count(const OstContext *ctx);
const char *ost_warning(const OstContext *ctx, int number);

/* Local. Frees an array that a function handed out as the caller's to free. NULL is allowed. */
void ost_free_memory(void *memory);

/* Local. Asks the C library to keep what is freed for what is allocated next, where it would give large blocks back to
 * the system and have them cleared page by page when they are asked for again: a third of the time of a large setup.
 * For a program that is Orthostat's own, before it starts MPI. Does nothing where the C library is not GNU's. */
void ost_keep_freed_memory(void);

/* Local. Seconds on a clock that only moves forward. */
double ost_seconds(void);

OST_API_END

#endif

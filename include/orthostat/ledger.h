/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_LEDGER_H
#define ORTHOSTAT_LEDGER_H

#include "orthostat/status.h"

#include <stddef.h>

OST_API_BEGIN

/* The ledger books every second and every byte of a run to an account: a phase of the work, or an effect of the scene
 * (effect/effect.h). Seconds are exclusive: entering an account stops the clock of the one around it, so the
 * accounts add up to the whole run. Bytes are booked to the account that is open when they are allocated. What is done
 * for an effect is booked to the effect, whatever phases it goes through. Columns: name, label. */
#define OST_LEDGER_TABLE(X)                    \
    X(OST_LEDGER_OTHER, "other")               \
    X(OST_LEDGER_CASE, "case")                 \
    X(OST_LEDGER_MESH, "mesh")                 \
    X(OST_LEDGER_PARTITION, "partition")       \
    X(OST_LEDGER_SELECTION, "selection")       \
    X(OST_LEDGER_PATTERN, "stiffness pattern") \
    X(OST_LEDGER_STIFFNESS, "stiffness")       \
    X(OST_LEDGER_SUPPORTS, "supports")         \
    X(OST_LEDGER_HIERARCHY, "multigrid setup") \
    X(OST_LEDGER_SOLVE, "solve")               \
    X(OST_LEDGER_CHECKS, "checks")             \
    X(OST_LEDGER_OUTPUT, "output")

/* The phases, and after them room for effects; which those are, the ledger need not know. */
#define OST_LEDGER_ENUM(name, label) name,
typedef enum {
    OST_LEDGER_TABLE(OST_LEDGER_ENUM) OST_LEDGER_PHASES,
    OST_LEDGER_ACCOUNTS = OST_LEDGER_PHASES + 40
} OstPhase;
#undef OST_LEDGER_ENUM

/* An OstPhase or an OstEffect. */
typedef int OstAccount;

/* What a rank computed and sent: counts, which do not depend on the machine. */
typedef struct OstWork {
    double multiplied; /* entries of matrices (stiffness, levels, prolongators, smoothers) that were multiplied */
    double exchanges;  /* rounds of messages between neighbours */
    double messages;   /* sent to neighbours, and their bytes */
    double bytes;
    double reductions; /* sums, maxima and agreements over all ranks */
    double gathers;    /* collections of something from all ranks, and the bytes that arrived */
    double gathered;
    double visits; /* of a level of multigrid */
} OstWork;

typedef struct OstLedgerEntry {
    double seconds;    /* exclusive of the accounts entered within */
    long entries;      /* how often the account was entered from another one */
    size_t bytes;      /* held now */
    size_t peak_bytes; /* the most held at any time */
    OstWork work;
} OstLedgerEntry;

struct OstContext;

/* Local. Gives an account a label, which is not copied; phases have theirs from the start. */
void ost_ledger_name(struct OstContext *ctx, OstAccount account, const char *label);
const char *ost_ledger_label(const struct OstContext *ctx, OstAccount account);

/* Local. Opens an account / closes the innermost one. They nest (at most 32 deep). A phase entered within an effect is
 * part of that effect. */
void ost_ledger_enter(struct OstContext *ctx, OstAccount account);
void ost_ledger_leave(struct OstContext *ctx);

/* Local. Books so many multiplied entries of a matrix to the innermost account. */
void ost_ledger_multiplied(struct OstContext *ctx, double entries);

/* Local. Books a round of messages to neighbours, reductions over all ranks, or bytes gathered from all ranks, to the
 * innermost account. */
void ost_ledger_sent(struct OstContext *ctx, int messages, double bytes);
void ost_ledger_reduced(struct OstContext *ctx, int times);
void ost_ledger_gathered(struct OstContext *ctx, double bytes);

/* Local. Until the next call all work of the solve is booked to this level of multigrid too (the finest is 0); -1: to
 * none. */
enum { OST_LEDGER_LEVELS = 16 };
void ost_ledger_level(struct OstContext *ctx, int level);
void ost_ledger_visited(struct OstContext *ctx);
OstWork ost_ledger_level_work(const struct OstContext *ctx, int level);

/* Local. Forgets the work booked so far, of all accounts and levels. For counting one of several runs in one context.
 */
void ost_ledger_forget_work(struct OstContext *ctx);

/* Local. What this rank booked so far; running clocks are brought up to date first. */
OstLedgerEntry ost_ledger_entry(struct OstContext *ctx, OstAccount account);

/* Local. Bytes held now and at most, over all accounts of this rank. */
size_t ost_ledger_bytes(const struct OstContext *ctx);
size_t ost_ledger_peak_bytes(const struct OstContext *ctx);

/* Local. Forgets the peaks so far, of all accounts: what is held now is the peak until more is. For measuring one of
 * several runs in one context. */
void ost_ledger_restart_peak(struct OstContext *ctx);

OST_API_END

#endif

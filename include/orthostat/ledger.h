/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_LEDGER_H
#define ORTHOSTAT_LEDGER_H

#include "orthostat/status.h"

#include <stddef.h>

OST_API_BEGIN

/* The ledger books every second and every byte of a run to a phase of the work or to an effect of the scene. Seconds
 * are exclusive: entering an account stops the clock of the one around it, so the accounts add up to the whole run.
 * Bytes are booked to the account that is open when they are allocated. An effect that is off is never entered.
 * Columns: name, is it an effect, label. */
#define OST_LEDGER_TABLE(X)                                   \
    X(OST_LEDGER_OTHER, 0, "other")                           \
    X(OST_LEDGER_CASE, 0, "case")                             \
    X(OST_LEDGER_MESH, 0, "mesh")                             \
    X(OST_LEDGER_PARTITION, 0, "partition")                   \
    X(OST_LEDGER_SELECTION, 0, "selection")                   \
    X(OST_LEDGER_PATTERN, 0, "stiffness pattern")             \
    X(OST_LEDGER_STIFFNESS, 0, "stiffness")                   \
    X(OST_LEDGER_SUPPORTS, 0, "supports")                     \
    X(OST_LEDGER_HIERARCHY, 0, "multigrid setup")             \
    X(OST_LEDGER_SOLVE, 0, "solve")                           \
    X(OST_LEDGER_CHECKS, 0, "checks")                         \
    X(OST_LEDGER_RECOVERY, 0, "strain and stress")            \
    X(OST_LEDGER_OUTPUT, 0, "output")                         \
    X(OST_EFFECT_ORTHOTROPY, 1, "orthotropy")                 \
    X(OST_EFFECT_VARYING_AXES, 1, "varying axes")             \
    X(OST_EFFECT_GRADIENT_AXES, 1, "gradient axes")           \
    X(OST_EFFECT_REGIONS, 1, "several materials")             \
    X(OST_EFFECT_GIVEN_DISPLACEMENT, 1, "given displacement") \
    X(OST_EFFECT_SLIDING, 1, "sliding support")               \
    X(OST_EFFECT_POINT_FORCE, 1, "point force")               \
    X(OST_EFFECT_SURFACE_LOAD, 1, "surface load")             \
    X(OST_EFFECT_BODY_FORCE, 1, "body force")

#define OST_LEDGER_ENUM(name, is_effect, label) name,
typedef enum { OST_LEDGER_TABLE(OST_LEDGER_ENUM) OST_LEDGER_COUNT } OstAccount;
#undef OST_LEDGER_ENUM

typedef struct OstLedgerEntry {
    double seconds;    /* exclusive of the accounts entered within */
    long entries;      /* how often the account was entered */
    size_t bytes;      /* held now */
    size_t peak_bytes; /* the most held at any time */
} OstLedgerEntry;

struct OstContext;

const char *ost_account_label(OstAccount account);
int ost_account_is_effect(OstAccount account);

/* Local. Opens an account / closes the innermost one. They nest (at most 32 deep). */
void ost_ledger_enter(struct OstContext *ctx, OstAccount account);
void ost_ledger_leave(struct OstContext *ctx);

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

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_SUMMARY_H
#define ORTHOSTAT_OUTPUT_SUMMARY_H

#include "adapt/adapt.h"
#include "orthostat/path.h"
#include "problem/result_data.h"
#include "problem/scene_data.h"

/* The ledger over all ranks: seconds of the slowest rank, sums of bytes and of multiplied entries. */
typedef struct OstLedgerSummary {
    double seconds[OST_EFFECT_END];
    double peak_bytes[OST_EFFECT_END];
    long entries[OST_EFFECT_END];
    double multiplied[OST_EFFECT_END]; /* entries of matrices */
    double total_seconds;              /* since the context was made */
    double peak_tracked_bytes;         /* of our own arrays, all ranks */
    double peak_process_bytes;         /* as the system saw the processes, all ranks */
} OstLedgerSummary;

/* Collective. */
OstStatus ost_ledger_summarise(OstContext *ctx, OstLedgerSummary *summary);

/* Local; only rank 0 prints: a run in a few lines, then the ledger. `file` is where the fields were written, or NULL;
 * tables of probes have the name `probes`, which is that of the file unless several results share it. */
void ost_summary_print(const OstScene *scene, const OstResult *result, const char *file, const char *probes);
void ost_ledger_print(const OstScene *scene, const OstLedgerSummary *summary);

/* Local; only rank 0 writes. The same as JSON, to a file (written aside and renamed) or, for "-", to standard output.
 * `path` is that which led to the result, or NULL, as is `adaption`; `watched` holds the case's quantities of interest,
 * in their order.
 */
OstStatus ost_summary_write_json(const OstScene *scene, const OstResult *result, OstPath *path,
                                 const OstLedgerSummary *summary, const OstWatchedValue *watched, const char *file,
                                 const OstAdaption *adaption, const char *to);

/* Local. The objects in it: the whole, without the ledger where `summary` is NULL; and the ledger, with products over
 * so many nonzeros of the stiffness (0: not known). The caller's references, NULL if jansson fails. */
struct json_t;
struct json_t *ost_summary_json(const OstScene *scene, const OstResult *result, const OstLedgerSummary *summary,
                                const OstWatchedValue *watched, const char *file);
struct json_t *ost_ledger_json(const OstContext *ctx, double nonzeros, const OstLedgerSummary *summary);

/* Local. Warnings of an answer that passes every check: strains or rotations too large for linear theory, a curved
 * surface of plane faces, which are told once of all steps of a path; tets turned inside out, a jump, a coarse mesh.
 * Returns 0, and leaves the text empty, where the one of this number (below OST_WARNINGS) has no cause. */
enum { OST_WARNINGS_OF_ALL_STEPS = 2, OST_WARNINGS = 9, OST_LONGEST_WARNING = 400 };
int ost_result_warning(const OstResult *result, int number, char text[OST_LONGEST_WARNING]);

/* Local. The first of these, of any answer of linear theory; linear_alone: large rotations cannot be solved for. */
int ost_linearity_warning(const OstChecks *checks, int linear_alone, char text[OST_LONGEST_WARNING]);

/* Local. The effects of a scene as a list of {effect, on, reason, bytes}, the bytes as predicted; the caller's
 * reference, NULL if jansson fails. */
struct json_t *ost_effects_json(const OstEffects *effects);

/* Local. The reasons of the solver's plan as a list of strings; likewise. */
struct json_t *ost_solver_reasons_json(const OstSolverPlan *plan);

#endif

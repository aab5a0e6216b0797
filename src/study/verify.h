/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_VERIFY_H
#define ORTHOSTAT_STUDY_VERIFY_H

#include "orthostat/scene.h"
#include "orthostat/verify.h"
#include "study/formula/formula.h"

/* Runs a case up the ladder of its verify section and holds what is measured against its formula. */

/* One quantity on one mesh. Over faces and nodes the error is the larger of the mean's and of the root mean square of
 * the answer's distance from the formula's field: errors of both signs cannot cancel, and so converge with their order.
 * The energy norm is that of the method: of a mode that quadratic tets see by its mean alone, the mean counts. */
typedef struct OstVerifyReading {
    double expected, obtained; /* FIELD: norms of the formula's field, and of the difference */
    double error;              /* relative */
} OstVerifyReading;

/* One mesh. */
typedef struct OstVerifyRun {
    int step, refinement;
    OstGlobal tets, unknowns;
    double h; /* edge of a cube of six tets of the mean volume */
    double seconds;
    int iterations;
    int warned_of_locking;
    OstChecks checks;
    OstVerifyReading *reading; /* quantity_count */
} OstVerifyRun;

/* One quantity on one step of the ladder: its finest mesh, and the rate at which it got there. */
typedef struct OstVerifyVerdict {
    int run;     /* the finest, or -1: the step was not run */
    double rate; /* between the last two meshes; NAN: one mesh only, or nothing left but rounding */
    double error_limit;
    double order; /* of convergence in theory, or as OstVerifyQuantity.rate */
    int passed;
} OstVerifyVerdict;

typedef struct OstVerifyReport {
    OstContext *ctx;
    OstCase *c;
    char *name; /* of the case file, without folder and ending */
    int run_count;
    OstVerifyRun *run;
    OstVerifyVerdict *verdict;                                  /* quantity_count × step_count */
    double force_imbalance, moment_imbalance, energy_imbalance; /* the worst of all runs */
    double seconds;
    char *failure; /* why a run gave no answer, or NULL */
    int passed;
} OstVerifyReport;

/* Loads and reactions balance to the first in every run, in force and moment; strain energy and work to the second. */
extern const double ost_verify_balance, ost_verify_energy_balance;

/* The order that is observed between the last two meshes is at least this share of theory's. Where an order is lost no
 * more than three quarters of it are left. Quick runs end before orders settle, and are held to less. */
extern const double ost_verify_share_of_order, ost_verify_quick_share_of_order;

/* Collective. Runs a case; `quick` stops at the levels marked so. A run that does not converge, or whose result does
 * not pass its own checks, is a case that fails, not a failure of this function, which raises for files that cannot be
 * read or used. */
OstStatus ost_verify_case(OstContext *ctx, const char *path, int quick, OstVerifyReport **report);
void ost_verify_report_destroy(OstVerifyReport **report);

/* Collective. One quantity of an answer. */
OstStatus ost_verify_measure(const OstScene *scene, const OstResult *result, const OstExact *exact,
                             const OstVerifyQuantity *quantity, OstVerifyReading *reading);

/* Local; rank 0 prints and writes. A case's table: the finest meshes or, with `all`, every one; the summary of several
 * cases; and the JSON of them. */
void ost_verify_print(const OstVerifyReport *report, int all);
void ost_verify_print_summary(int count, OstVerifyReport *const *reports);
OstStatus ost_verify_write_json(OstContext *ctx, int count, OstVerifyReport *const *reports, int quick,
                                const char *path);

#endif

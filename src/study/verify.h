/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_VERIFY_H
#define ORTHOSTAT_STUDY_VERIFY_H

#include "case/verify.h"
#include "problem/scene_data.h"
#include "study/formula/formula.h"

/* Solves a case on the meshes of its verify section and compares what is measured with its formula. */

/* One quantity on one mesh. Over faces and nodes the error is the larger of the mean's and of the root mean square of
 * the answer's distance from the formula's field: errors of both signs cannot cancel, and so converge with their order.
 * With the mean-dilatation element the energy norm uses the element's mean of the stiff mode. */
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
    double energy_error; /* relative, in the norm of the energy: of the answer, and as it is estimated */
    double estimate;
    double effectivity;        /* the latter over the former; NAN: the elements hold the solution */
    OstVerifyReading *reading; /* quantity_count */
} OstVerifyRun;

/* One quantity, by elements of one order: the result on the finest mesh, and the rate of convergence. */
typedef struct OstVerifyVerdict {
    int run;     /* the finest, or -1: none was run */
    double rate; /* between the last two meshes; NAN: one mesh only, or the error is rounding */
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
    double effectivity[2]; /* least and most, from the second mesh of each order on; NAN: none */
    int estimated;         /* are all of these within the range? */
    double seconds;
    char *failure; /* why a run gave no answer, or NULL */
    int passed;
} OstVerifyReport;

/* Collective. Runs a case, changed by settings KEY=VALUE (ost_case_read_with); `quick` stops at the levels that the
 * case marks. Where a run does not converge, or its result fails its own checks, the report says that the case failed.
 * Raises only for files that cannot be read or used.
 */
OstStatus ost_verify_case(OstContext *ctx, const char *path, int settings, const char *const *setting, int quick,
                          OstVerifyReport **report);
void ost_verify_report_destroy(OstVerifyReport **report);

/* Collective. One quantity of an answer. */
OstStatus ost_verify_measure(const OstScene *scene, const OstResult *result, const OstExact *exact,
                             const OstVerifyQuantity *quantity, OstVerifyReading *reading);

/* Local; rank 0 prints and writes: a case's table (the finest meshes; with `all`, every one), the summary of several
 * cases, and their JSON. */
void ost_verify_print(const OstVerifyReport *report, int all);
void ost_verify_print_summary(int count, OstVerifyReport *const *reports);
OstStatus ost_verify_write_json(OstContext *ctx, int count, OstVerifyReport *const *reports, int quick,
                                const char *path);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_LOAD_CASE_FILES_H
#define ORTHOSTAT_OUTPUT_LOAD_CASE_FILES_H

#include "output/summary.h"

#include <stddef.h>

/* What comes of load cases: the fields of each, and bridge_cases.csv, a line for each. For bridge.vtkhdf the fields are
 * steps of that file, where all have one mesh; else each has a file, bridge_wind.vtkhdf, bridge_wind.hdf or
 * bridge_wind.vtu, and bridge.hdf.series or bridge.pvd lists them in their order. */

/* One load case, solved or not. Start from {0}. */
typedef struct OstLoadCaseReport {
    const OstCase *c;
    const char *name;
    OstStatus status;
    char *failure; /* why there is no answer, or no more accurate one; NULL if there is one */
    int is_short;  /* is there an answer, but not as accurate as it was asked to be? */
    int is_known;  /* are the numbers below there? */
    double largest_displacement, strain_energy;
    double relative_error; /* that the mesh makes; NAN if not known */
    int iterations, newton_iterations;
    double nonzeros;
    OstFailure failing;       /* the least load factors, if a material has strengths */
    OstWatchedValue *watched; /* c->watch_count */
    char *file;               /* its fields; NULL: not written */
    struct json_t *json;      /* as of a single run, on rank 0 */
} OstLoadCaseReport;

/* Local. Takes the numbers of a result, its quantities of interest, its levels, or NULL, and the file that it was
 * written to, or NULL. */
OstStatus ost_load_case_note(const OstScene *scene, const OstResult *result, OstWatchedValue *watched,
                             const OstAdaption *adaption, const char *file, OstLoadCaseReport *report);
void ost_load_case_report_release(OstLoadCaseReport *report);

/* Local. Do the fields of all go into one file? */
int ost_load_cases_in_one_file(const OstCase *c, const char *output);

/* Local. The names of files, by that of the case's output file. Those of probes have the first too. */
void ost_load_case_fields_name(const char *output, const char *name, size_t size, char *path);
void ost_load_case_table_name(const char *output, size_t size, char *path);

/* Local; rank 0 writes: the list of files for ParaView, if there are several, and the table. */
OstStatus ost_load_cases_write(const OstCase *c, int count, const OstLoadCaseReport *reports, const char *output);

/* Local; rank 0 prints the table and where everything is. */
void ost_load_cases_print(const OstScene *scene, int count, const OstLoadCaseReport *reports, const char *output);

/* Local; rank 0 writes: everything as JSON. Takes the reports' objects and that of the envelope, which may be NULL. */
OstStatus ost_load_cases_write_json(const OstScene *scene, int count, OstLoadCaseReport *reports,
                                    struct json_t *envelope, const OstLedgerSummary *summary, const char *output,
                                    const char *to);

#endif

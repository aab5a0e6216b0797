/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_SOLVE_CASES_H
#define ORTHOSTAT_CLI_SOLVE_CASES_H

#include "adapt/adapt.h"
#include "case/case_data.h"

/* Collective. Can the files of all load cases be written beside `output`? Raises as ost_check_outputs does. */
OstStatus ost_cli_check_case_outputs(const OstCase *c, const char *output);

/* How load cases are to be solved and told. */
typedef struct OstSolveCases {
    const char *output, *json;    /* `json` may be NULL */
    int keeps;                    /* also what is no answer is written */
    const OstAdaptLimits *limits; /* where the case asks for an accuracy */
} OstSolveCases;

/* Collective. Solves every load case of the case, whatever becomes of the others, writes their fields and tells of all.
 * Raises the first failure, naming all that have failed. */
OstStatus ost_cli_solve_cases(const OstCase *c, const OstSolveCases *how);

#endif

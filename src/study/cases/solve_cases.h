/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_CASES_SOLVE_CASES_H
#define ORTHOSTAT_STUDY_CASES_SOLVE_CASES_H

#include "adapt/adapt.h"
#include "case/case_data.h"

/* How load cases are to be solved and told. */
typedef struct OstSolveCases {
    const char *output, *json;    /* `json` may be NULL, or "-" */
    int keeps;                    /* also what is no answer is written */
    const OstAdaptLimits *limits; /* where the case asks for an accuracy */
} OstSolveCases;

/* Collective. Solves every load case of the case, whatever becomes of the others, writes their fields and tells of all.
 * Raises the first failure, naming all that have failed. */
OstStatus ost_solve_cases(const OstCase *c, const OstSolveCases *how);

#endif

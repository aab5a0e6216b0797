/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_LOAD_CASES_H
#define ORTHOSTAT_LOAD_CASES_H

#include "orthostat/scene.h"

OST_API_BEGIN

/* The load cases of a scene's case, solved one after another. Those that hold the body alike share its stiffness and
 * the solver's hierarchy or factors, and follow each other. */
typedef struct OstLoadCases OstLoadCases;

/* Collective. Checks the supports of all. The scene outlives them. */
OstStatus ost_load_cases_create(const OstScene *scene, OstLoadCases **cases);
void ost_load_cases_destroy(OstLoadCases **cases);

/* Local. How many there are, how many are still to be solved, and how many stiffnesses that takes in all. */
int ost_load_cases_count(const OstLoadCases *cases);
int ost_load_cases_left(const OstLoadCases *cases);
int ost_load_cases_stiffnesses(const OstLoadCases *cases);

/* Local. The load case that is solved next; its scene, which lives as long as all of them. */
int ost_load_cases_next(const OstLoadCases *cases);
const OstScene *ost_load_cases_scene(const OstLoadCases *cases, int number);

/* Collective. Solves it; result and failures as of ost_analysis_solve. After a failure the others can be solved still.
 */
OstStatus ost_load_cases_solve(OstLoadCases *cases, unsigned fields, OstResult **result);

OST_API_END

#endif

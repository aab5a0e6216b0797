/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_CASES_COMPANY_H
#define ORTHOSTAT_SOLVE_CASES_COMPANY_H

#include "solve/strategy.h"

/* Load cases of one stiffness that are solved at the same time, each as it would be alone, by tasks (core/together):
 * products with the stiffness, multigrid cycles and visits to the tets are then made for several of them at once. */
typedef struct OstCompanion {
    const OstScene *scene; /* of the load case */
    unsigned fields;       /* asked for */
    int is_tried;
    OstResult *result; /* NULL: it did not come through, and is to be solved alone */
} OstCompanion;

/* Collective. May loadings of this analysis, which is made, be solved in company? By linear theory, multigrid, and
 * without what would need a solve of its own. */
int ost_company_suits(const OstAnalysis *analysis);

/* Collective. How many may be solved at once, by the memory that is free; at most OST_MOST_TOGETHER. */
OstStatus ost_company_most(OstContext *ctx, int *most);

/* Collective. Solves them. What keeps one from being solved leaves it without a result. */
OstStatus ost_company_solve(OstAnalysis *analysis, int count, OstCompanion *companion);

#endif

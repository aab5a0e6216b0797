/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_PLAN_PARTS_H
#define ORTHOSTAT_CASE_PLAN_PARTS_H

#include "orthostat/plan.h"

/* What the materials of a case ask for. Materials that a later one replaces for certain do not count. */
typedef struct OstPlanMaterials {
    int count;
    int orthotropic; /* how many are not isotropic */
    int varying;     /* how many of those have axes that differ from place to place */
    const char *gradient_region;
    char orthotropic_reason[160];
    char varying_reason[160];
    OstSolverFacts facts; /* of the materials */
} OstPlanMaterials;

void ost_plan_materials(const OstCase *c, const OstFileMaterials *from_file, OstPlanMaterials *materials);

/* Local. Adds a material to what the solver's plan asks of them, ratios of moduli and Poisson's ratio; `softest` and
 * `stiffest` are the least and largest Young's modulus so far, 0 to begin with. */
void ost_plan_add_facts(OstContext *ctx, const OstOrthotropic *k, double *softest, double *stiffest,
                        OstSolverFacts *facts);

/* Fills the plan's bytes from its nodes, tets, recipe and effects. */
void ost_plan_memory(const OstCase *c, int ranks, OstPlan *plan);

#endif

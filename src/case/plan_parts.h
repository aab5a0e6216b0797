/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_PLAN_PARTS_H
#define ORTHOSTAT_CASE_PLAN_PARTS_H

#include "case/plan.h"

/* Local. What the materials in use ask for. */
void ost_plan_materials(const OstCase *c, const OstPlanMesh *mesh, OstEffectFacts *facts, OstSolverFacts *solver);

/* Local. The effect of a load, or OST_EFFECT_END where only the mesh can tell. */
OstEffect ost_load_effect(const OstCase *c, const OstLoad *load);

/* Local. Adds a material to what the solver's plan asks of them, ratios of moduli and Poisson's ratio; `softest` and
 * `stiffest` are the least and largest Young's modulus so far, 0 to begin with. */
void ost_plan_add_facts(OstContext *ctx, const OstOrthotropic *k, double *softest, double *stiffest,
                        OstSolverFacts *facts);

/* Local. Is a field among the output? */
int ost_plan_writes(const OstCase *c, OstOutputFieldBit field);

/* Local. Fills the plan's bytes from its nodes, tets, method and effects. */
void ost_plan_memory(const OstCase *c, int quadratic, int ranks, OstPlan *plan);

#endif

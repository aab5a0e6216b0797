/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_PLAN_PARTS_H
#define ORTHOSTAT_CASE_PLAN_PARTS_H

#include "case/plan.h"

/* Local. Fills the facts of the materials in use that effects and solver depend on. */
void ost_plan_materials(const OstCase *c, const OstPlanMesh *mesh, OstEffectFacts *facts, OstSolverFacts *solver);

/* Local. The effect of a load, or OST_EFFECT_END if it depends on the mesh. */
OstEffect ost_load_effect(const OstCase *c, const OstLoad *load);

/* Local. Adds a material to the facts that the solver's plan needs: ratios of moduli, and Poisson's ratio. `softest`
 * and `stiffest` are the smallest and largest Young's modulus so far, 0 to begin with. */
void ost_plan_add_facts(OstContext *ctx, const OstOrthotropic *k, double *softest, double *stiffest,
                        OstSolverFacts *facts);

/* Local. Is a field among those to be written? */
int ost_plan_writes(const OstCase *c, OstOutputFieldBit field);

/* Local. Predicts the plan's bytes from its nodes, tets, method and effects. */
void ost_plan_memory(const OstCase *c, int quadratic, int ranks, OstPlan *plan);

#endif

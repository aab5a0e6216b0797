/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_PROBLEM_H
#define ORTHOSTAT_PROBLEM_PROBLEM_H

#include "assembly/system.h"
#include "orthostat/problem.h"
#include "problem/scene_data.h"

struct OstProblem {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstMaterialField *field;
    const OstCase *c;          /* where supports and loads come from, for messages; may be NULL */
    const OstEffects *effects; /* the scene's; NULL if there is no scene */
    OstSupports *supports;     /* with the displacements prescribed at t = 1 */
    double *force;             /* 3 × owned_nodes: the load at t = 1 */
    OstSystem *system;         /* NULL before ost_problem_stiffness, and after its release */
    int filled;                /* does the matrix have values? */
    int linear;                /* is the internal force linear in the displacement? */
    OstFormulation formulation;
    int free_body;
    int with_metric;      /* is the body orthotropic, so that multigrid needs the material metric? */
    OstSolverFacts facts; /* of the materials */
};

/* Local. What messages begin with: the case's file, or "the problem". */
const char *ost_problem_name(const OstProblem *problem);

/* Local. The right-hand side P (load(t) - K t g) of a linear problem, g the prescribed displacements, after
 * ost_problem_stiffness. `rhs` has 3 × rows numbers. */
OstStatus ost_problem_right_hand_side(const OstProblem *problem, double t, double *rhs);

/* Collective. The displacement u = P v + t g of every local node, from v of the rows. */
OstStatus ost_problem_displacement(const OstProblem *problem, double t, const double *v, double *u);

/* Collective. What the plan of the solver depends on: facts of the materials, the mesh, the unknowns and the machines.
 */
OstStatus ost_problem_facts(const OstProblem *problem, OstSolverFacts *facts);

#endif

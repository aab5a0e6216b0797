/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_REACTIONS_REACTIONS_H
#define ORTHOSTAT_SOLVE_REACTIONS_REACTIONS_H

#include "accuracy/estimate.h"
#include "algebra/solver.h"

/* Watched reactions of answers, whose equations may be solved to the error of the mesh alone. A reaction is R = a(u,
 * w) - l(w) for any displacement w that is 1 along it at its nodes and 0 at other supports. Summed over the nodes, w
 * ends within a layer of tets, and what u leaves out of balance beside them counts in full. With z, the w that has the
 * least energy (the adjoint problem's), it counts times the error of z alone, and the error that the mesh makes is the
 * work of u's residual on the surplus of z. Where a rigid motion of the body is such a w, statics alone gives R. */

/* Mean stresses of a mixed form have adjoint problems too, by linear theory: the error of u and p, found by few steps,
 * has half to two thirds of a mean's error, and the work of what u and p leave on the surplus of z four fifths. So have
 * those of bodies whose moduli differ far. */

/* The adjoint problems of earlier loads on the same supports; start from {0}. */
enum { OST_MOST_REACTIONS = 12 };
typedef struct OstReactions {
    int count;
    double *moved[OST_MOST_REACTIONS]; /* 3 × node_count: which reaction it is */
    OstAdjoint *adjoint[OST_MOST_REACTIONS];
    int mean_count;
    const OstWatch *mean[OST_MOST_REACTIONS]; /* of which mean stress */
    OstAdjoint *of_mean[OST_MOST_REACTIONS];
} OstReactions;
void ost_reactions_clear(OstReactions *kept);

/* Local. To which share of z an adjoint problem is solved: u has this relative error in the norm of the energy. */
double ost_share_of_adjoint(double relative);

/* Local. May the solve stop early, although the case watches reactions? Not where nodes follow others or the pressure
 * is an unknown. */
int ost_reactions_allow_stop(const OstProblem *problem);

/* Local. May a watched reaction have an adjoint problem? Not where the stiffness has an unsymmetric part. */
int ost_reactions_have_adjoint(const OstProblem *problem);

/* Local. Is this how the solve of an adjoint problem ends that has no answer: of an indefinite stiffness, or as no
 * strategy was left? */
int ost_adjoint_has_no_answer(OstStatus status);

/* Local. Has a watched quantity an adjoint problem of its own: a reaction, or a mean stress as above? */
int ost_reactions_are_watched(const OstProblem *problem);

/* Collective. A reaction that statics alone gives is known; no other one is, nor another quantity. */
OstStatus ost_reactions_by_statics(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                                   OstWatchedReaction *found);

/* Collective. The same of mean stresses; `imbalance`: 3 × owned_nodes, internal forces less loads; the others
 * as below. */
OstStatus ost_mean_stresses_find(const OstProblem *problem, OstEstimate *estimate, OstSolver *solver, double t,
                                 const double *u, const double *imbalance, const double *tet_error, OstReactions *kept,
                                 OstWatchedReaction *found);

/* Collective. What is to be added to each watched reaction and mean stress, and its error: found (one for each quantity
 * watched) is filled for those that are known, and stays where it was known before. `relative`: the error of u in the
 * norm of the energy, and tet_error each tet's share of its square. What is found for this load is kept for the next,
 * unless `kept` is NULL. */
OstStatus ost_reactions_find(const OstProblem *problem, OstEstimate *estimate, OstSolver *solver, double t,
                             const double *u, double relative, const double *tet_error, OstReactions *kept,
                             OstWatchedReaction *found);

#endif

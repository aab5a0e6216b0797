/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_PRESSURE_ERROR_H
#define ORTHOSTAT_ACCURACY_PRESSURE_ERROR_H

#include "accuracy/search.h"

/* A displacement (3 × node_count, ghosts included) whose pressure the problem's field has. */
typedef struct OstState {
    const OstProblem *problem;
    const double *u;
    double eigen_share;
} OstState;

/* Collective, after the steps of a mixed form's estimate by linear theory. They have found the e of which A e balances
 * what u and p leave; that is the displacement's error and what the pressure's brings with it, A e = A e_u + B'e_p. So
 * e_p, linear in each tet, is what e leaves of the second equation, over what B A^-1 B' is about in a solve too; the
 * displacement that this takes off e is found by steps as e was. (To do both again with what is left gains nothing.)
 * of_tets (4 × tet_count, 0 on entry): e_p at the vertices; the search's e becomes e_u, already lengthened.
 * steps.failed: not known. */
OstStatus ost_pressure_error(Search *search, OstSolver *solver, const OstState *of, double *of_tets);

/* Collective. The work of such a pressure on what a state leaves of the second equation. */
OstStatus ost_pressure_work(const OstEstimate *estimate, const OstState *of, const double *of_tets, double *work);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_CASES_LOAD_CASE_H
#define ORTHOSTAT_PROBLEM_CASES_LOAD_CASE_H

#include "problem/problem.h"

/* Several loadings of one body. */

/* Collective. A number for what the supports of the scene's case hold: their directions and springs, not by how much
 * they move; and for the method, linear or not. Where it is the same on every rank, so is the
 * stiffness, and what is done with it. */
OstStatus ost_scene_support_hash(const OstScene *scene, uint64_t *hash);

/* Local. Puts what acts on another problem of the same body and supports in place of what acts on this one, whose
 * stiffness stays. The other may then be destroyed; its scene must outlive this one. */
void ost_problem_take_loading(OstProblem *problem, OstProblem *other);

#endif

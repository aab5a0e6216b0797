/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_BUCKLING_BUCKLING_H
#define ORTHOSTAT_SOLVE_BUCKLING_BUCKLING_H

#include "algebra/solver.h"
#include "problem/problem.h"
#include "problem/result_data.h"

/* Collective. The lowest load factors at which the body of a linear answer buckles, as many as the problem asks for, in
 * result->buckling, and their modes (OST_EFFECT_BUCKLING). */
OstStatus ost_buckling_find(const OstProblem *problem, OstSolver *solver, OstResult *result);

/* Local. Is buckling alone what linear theory is off by, and the load beyond it? Newton's method would then follow the
 * body to a state that depends on what is not in the scene, in hundreds of iterations: that is for the user to ask for.
 */
int ost_buckling_ends(const OstResult *result);

/* Local. Objects to the linear answer of such a body. */
void ost_buckling_object(OstResult *result);

/* Collective. Is a linear answer near buckling, or past it? Looks for it only where strains and the shape of the body
 * allow it, and no further than tells; raises result->newton.linear_error to 1 / load factor where that is below
 * 1.25. Of a mixed form the stiffness is taken without its pressures first, which tells that a body is far from it. A
 * load that has no work function is not judged. */
OstStatus ost_buckling_judge(const OstProblem *problem, OstSolver *solver, OstResult *result);

/* Local. The load factor below which buckling is warned of: twice as high for linear tets, which lock as they bend. */
double ost_near_buckling(const OstMesh *mesh);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_GUARD_H
#define ORTHOSTAT_GUARD_GUARD_H

#include "problem/problem.h"
#include "problem/result_data.h"

/* What speaks against solving a problem, and against an answer. All checks add to one verdict; a check returns a
 * failure of its own only where it could not be made. */

/* Local. Adds an objection; `status` is what to fail with if it is the first. */
void ost_object(OstVerdict *verdict, OstStatus status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Local. The verdict as a failure, all objections in its message; OST_SUCCESS if there are none. */
OstStatus ost_verdict_raise(OstContext *ctx, const OstVerdict *verdict);

/* Collective, before anything is assembled. Objects to motions that nothing constrains (freedom.h). */
OstStatus ost_guard_supports(const OstProblem *problem, OstVerdict *before);

/* Collective, once the stiffness is filled and before a solver is built on it. Objects to numbers beyond what double
 * precision can square (number_range.h) and to rigid motions that meet a force (rigid_motion.h); `modes` are those that
 * multigrid is given. `resistance` becomes the most that a rigid motion was resisted, over |K| |motion|. */
OstStatus ost_guard_stiffness(const OstProblem *problem, const double *modes, double *resistance, OstVerdict *before);

/* Collective, before each solve. Objects to loads of a free body that do not balance (load_balance.h), and to a
 * right-hand side (3 × rows) out of range. */
OstStatus ost_guard_load(const OstProblem *problem, const double *rhs, OstVerdict *before);

/* What an answer is measured by: the right-hand side that was solved for, and the unknowns found. */
typedef struct OstSolvedFor {
    double norm; /* of the right-hand side */
    double work; /* of it on the unknowns; of use where the problem is linear */
} OstSolvedFor;

/* Collective, after a solve. Computes the reactions and result->checks from displacement and loads, with internal
 * forces summed tet by tet, without the assembled matrix, so that a mistake in it cannot hide. Objects with the numbers
 * to what does not hold: finite values, the true residual, forces and moments in balance, where the problem is linear,
 * strain energy equal to the work (Clapeyron), a digit left by rounding, and one of the forces. What the digits mean is
 * told in checks.c. `requested` is the relative residual that was asked for. */
OstStatus ost_guard_after(const OstProblem *problem, double requested, const OstSolvedFor *solved_for,
                          OstResult *result);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_GUARD_H
#define ORTHOSTAT_GUARD_GUARD_H

#include "assembly/batch.h"
#include "problem/problem.h"
#include "problem/result_data.h"

/* Checks before and after a solve. What they find wrong is added to one verdict; a check fails itself only if it could
 * not be made. */

/* Local. Adds an objection; the verdict fails with the `status` of the first. */
void ost_object(OstVerdict *verdict, OstStatus status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Local. The verdict as a failure, all objections in its message; OST_SUCCESS if there are none. */
OstStatus ost_verdict_raise(OstContext *ctx, const OstVerdict *verdict);

/* Collective, before anything is assembled. Objects to motions that nothing constrains (ost_freedom_check). */
OstStatus ost_guard_supports(const OstProblem *problem, OstVerdict *before);

/* Collective, once the stiffness is filled and before a solver is built on it. Objects to numbers whose squares leave
 * double precision (before.c) and to rigid motions that cost a force (rigid_motion.h); `modes` are those that
 * multigrid is given. `resistance` becomes the largest such force, over |K| |motion|. */
OstStatus ost_guard_stiffness(const OstProblem *problem, const double *modes, double *resistance, OstVerdict *before);

/* Collective, before each solve. Objects to loads of a free body, those of one function of time, that
 * do not balance, and to a right-hand side (3 × rows) out of range. */
OstStatus ost_guard_load(const OstProblem *problem, int function, const double *rhs, OstVerdict *before);

/* Collective, before each solve of a mixed form, with the right-hand side of its pressures. Objects where an
 * incompressible body is constrained all around and what is prescribed changes its volume: nothing solves that.
 * *enclosed: is it constrained all around, so that only the shape of the pressure is known, and not its mean? */
OstStatus ost_guard_volume(const OstProblem *problem, const double *g, int *enclosed, OstVerdict *before);

/* Collective. Names the worst tet, by number, place and quality, if that quality is below 0.01: it may be why rounding
 * hides the answer. Otherwise `words` becomes empty. */
enum { OST_WORST_TET_SIZE = 240 };
OstStatus ost_guard_worst_tet(const OstMesh *mesh, char words[OST_WORST_TET_SIZE]);

/* Collective. Adds the worst tet to the text of an OST_NOT_CONVERGED; returns `status`. */
OstStatus ost_guard_explain(const OstProblem *problem, OstStatus status);

/* Relative errors of an answer in the equations, in 2-norms. */
typedef struct OstErrors {
    int known;
    double displacement; /* over all nodes */
    double reaction;     /* of constrained nodes; over a thousandth of the loads, if that is more: loads may balance */
    double stress;       /* means of the tets, six components; with springs likewise */
    int corrected;       /* was the answer corrected until they were these? Then the residual says nothing beside them:
                            in stiff directions it is what the rounding of the displacement makes of it */
    int asked;           /* is the residual asked for their reason, not rounding? */
} OstErrors;

/* Collective. The errors of a displacement that is off by `error` (both 3 × node_count, ghosts included), of which
 * ost_problem_force_and_stress finds `internal` and `stress`. Of a mixed form `problem` has the answer's pressure, and
 * `of_error` that of the error; else they are the same. */
OstStatus ost_guard_errors(const OstProblem *problem, const OstProblem *of_error, const double *displacement,
                           const double *internal, double stress, const double *error, OstErrors *errors);

/* Collective. The same where rotations are large, at pseudo-time t: `internal` and `load` are the forces at the
 * displacement, 3 × owned_nodes. Not of a mixed form. */
OstStatus ost_guard_turned_errors(const OstProblem *problem, double t, const double *displacement,
                                  const double *internal, const double *load, const double *error, OstErrors *errors);

/* The sizes that errors of an answer are relative to, and its errors where the solver could find them. */
typedef struct OstSolvedFor {
    double norm; /* of the right-hand side */
    double work; /* of the right-hand side on the unknowns; used if the problem is linear */
    OstErrors errors;
} OstSolvedFor;

/* Collective, after a solve. Computes the reactions and result->checks from displacement and loads, with internal
 * forces summed tet by tet, without the assembled matrix, so that an error of assembly shows. Objects, with numbers,
 * unless all of this is true: values are finite; the true residual is what was asked for; forces and moments balance;
 * if the problem is linear, strain energy equals work (Clapeyron); the stated error is at most a tenth, in the
 * displacement and in the fields asked for. checks.c says how errors are estimated. `requested` is the relative
 * residual that was asked for. `also` is called, with the result, for the means of each batch of tets, which are found
 * on the way; or NULL. */
OstStatus ost_guard_after(const OstProblem *problem, double requested, const OstSolvedFor *solved_for,
                          OstMeansVisit also, OstResult *result);

/* Collective, before anything is assembled. Finds the connected components of the body (tets joined through faces) and
 * the rigid motions that supports, and hinges between components, leave them. Raises OST_INVALID_INPUT that describes
 * these motions if there are any, and for tets that occur twice. Warns of motions that are weakly constrained, and of
 * vertices that coincide where the body has several components. Messages begin with `where` (the case file).
 * `free_body`: the supports are those of a floating body, which changes the advice. */
OstStatus ost_freedom_check(const OstMesh *mesh, const OstSupports *supports, const char *where, int free_body);

#endif

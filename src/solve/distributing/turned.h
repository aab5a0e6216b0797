/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_DISTRIBUTING_TURNED_H
#define ORTHOSTAT_SOLVE_DISTRIBUTING_TURNED_H

#include "problem/problem.h"

/* Moved distributing couplings under large rotations. The selection's mean motion is that of the rigid body nearest to
 * it: the mean displacement, and the rotation R for which the integral of |x - x_mean - R (X - X_mean)|² is least, the
 * one of the polar decomposition of F = integral of (x - x_mean)(X - X_mean)'. (Abaqus integrates a mean spin over the
 * steps, so that its rotation depends on the path; R does not, and its forces have an energy. Both are the linear
 * coupling's where rotations are small.) So all that is given is a function c(z) of a few sums z = Y u, at most 12 a
 * coupling: the mean displacement, and F along the principal axes of the selection.
 *
 * With multipliers x the coupling's forces are Y'h, h = c'(z)' x. Newton's equations are K d = r + Y'dh, Y d = dz,
 * dh = h_z dz + c' dx and c' dz = g - c: with D = K^-1 Y' they are a small dense system. */
typedef struct OstTurnedCouplings OstTurnedCouplings;

/* Local. The number of multipliers. */
int ost_turned_couplings_count(const OstProblem *problem);

/* Local. Those that linear theory found, at t. */
void ost_turned_couplings_begin(const OstProblem *problem, double t, double *multipliers);

/* Collective. Takes their forces by linear theory off the load. `unknowns`: of a linear solve on this rank. */
OstStatus ost_turned_couplings_create(OstProblem *problem, size_t unknowns, OstTurnedCouplings **couplings);
void ost_turned_couplings_destroy(OstTurnedCouplings **couplings);

/* Collective. Takes them to a displacement (3 × node_count), the multipliers there, and what is given at t. */
OstStatus ost_turned_couplings_move(OstTurnedCouplings *couplings, double t, const double *u,
                                    const double *multipliers);

/* Local. How many solves a correction takes. */
int ost_turned_couplings_sums(const OstTurnedCouplings *couplings);

/* Local. Adds their forces there to those of the owned nodes. */
void ost_turned_couplings_add(const OstTurnedCouplings *couplings, double *force);

/* Local. What the given motions lack, as a force: the square of its norm. */
double ost_turned_couplings_lack(const OstTurnedCouplings *couplings);

/* Collective. Solves K x = rhs (both of `unknowns`). *found: 0 where the solver finds nothing. */
typedef OstStatus OstTurnedSolve(void *data, const double *rhs, double *x, int *found);

/* Collective. Makes of the correction that K alone has made of the residual the one that keeps what is given, and finds
 * the change of the multipliers. */
OstStatus ost_turned_couplings_correct(OstTurnedCouplings *couplings, OstTurnedSolve *solve, void *data,
                                       double *correction, double *change, int *found);

/* Local. With so many negative eigenvalues of K, as of the last correction: is the body stable while its motion is
 * given? */
OstStatus ost_turned_couplings_are_stable(const OstTurnedCouplings *couplings, OstGlobal negative, int *stable);

/* Collective. Counts their forces at t as those of the problem's load, as after a linear solve: of the function with
 * the largest factor there, as others may be 0. */
OstStatus ost_turned_couplings_apply(const OstTurnedCouplings *couplings, double t);

#endif

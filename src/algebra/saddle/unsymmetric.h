/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_UNSYMMETRIC_H
#define ORTHOSTAT_ALGEBRA_SADDLE_UNSYMMETRIC_H

#include "algebra/krylov/gmres.h"
#include "algebra/krylov/preconditioner.h"
#include "algebra/saddle/factors.h"
#include "algebra/saddle/norm.h"

/* Collective. Solves (A + S) u + B' p = f, B u - C p = g from 0 by GMRES, with S the further part, preconditioned by
 * factors of both equations or, where they are NULL, by a preconditioner of A and ost_coupling_schur_solve, one after
 * the other. `relative` and the outcome as in ost_gmres_iterate. */
OstStatus ost_saddle_solve_unsymmetric(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                                       const OstSaddleFactors *factors, const OstSaddle *saddle,
                                       const OstFurtherPart *further, double relative, const double *f, double *u,
                                       int *iterations, double *residual);

#endif

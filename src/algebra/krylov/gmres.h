/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_GMRES_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_GMRES_H

#include "algebra/krylov/preconditioner.h"

/* What a system has beside its stored, symmetric matrix A: y += S u, on vectors of 3 × rows numbers. Collective. */
typedef struct OstFurtherPart {
    void *data;
    OstStatus (*add)(void *data, const double *u, double *y);
} OstFurtherPart;

/* A system K x = b with its preconditioner, on vectors of n numbers: Collective. y = M^-1 K x. */
typedef struct OstGmresSystem {
    OstContext *ctx;
    size_t n;
    void *data;
    OstStatus (*apply)(void *data, const double *x, double *y);
} OstGmresSystem;

/* Collective. Solves M^-1 K x = b from x = 0 by AztecOO's GMRES until the residual is `relative` × ||b|| or less.
 * *residual: relative to ||b||, after that, or after 100 iterations, or where rounding allows no less. b may be
 * changed. Raises OST_OUT_OF_MEMORY if there is no room for GMRES's vectors (AztecOO would end the process). */
OstStatus ost_gmres_iterate(const OstGmresSystem *system, double relative, double *b, double *x, int *iterations,
                            double *residual);

/* Collective. Solves (A + S) u = f from u = 0 by AztecOO's GMRES on M^-1 (A + S), in scaled unknowns, until
 * ||M^-1 r|| <= relative ||M^-1 f||: about the error of u relative to u. Neither A nor S need be definite. *residual:
 * ||M^-1 r|| / ||M^-1 f|| after that, or after 100 iterations, or where rounding allows no less. Raises
 * OST_OUT_OF_MEMORY if there is no room for GMRES's vectors (AztecOO would end the process). */
OstStatus ost_gmres_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                          const OstFurtherPart *further, double relative, const double *f, double *u, int *iterations,
                          double *residual);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_LOCAL_SCHUR_H
#define ORTHOSTAT_ALGEBRA_SADDLE_LOCAL_SCHUR_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/saddle/coupling.h"

/* What the mass matrix does not know of the pressures' Schur complement S: next to fixed nodes and far stiffer
 * material, and where a ratio of moduli leaves the displacements of few tets free, S is far below it, at pressures that
 * differ from node to node. T = B D^-1 B' + C, with D the diagonal blocks of A, is small there too, and known. A share
 * of T^-1, by Chebyshev steps, is added to the mass matrix's inverse. Of smooth pressures T knows nothing: next to
 * fixed nodes it is restricted to the pressures with a small diagonal; else the steps leave the smooth ones out. */
typedef struct OstLocalSchur OstLocalSchur;

/* Local. For ost_coupling_schur_solve: where most nodes around a pressure are fixed, or far stiffer, S is below the
 * mass matrix by about as much as the diagonal of T is. *weights has a number of 1 or more for each owned pressure;
 * NULL where the system has no scaling. */
OstStatus ost_pressure_weights(const OstCgSystem *system, const OstCoupling *coupling, double **weights);

/* Collective. *local is NULL where the diagonals of T and S are not apart, or the system has no scaling. */
OstStatus ost_local_schur_create(const OstCgSystem *system, const OstCoupling *coupling, OstLocalSchur **local);
void ost_local_schur_destroy(OstLocalSchur **local);

/* Collective. z = z + its share of T^-1 r, of owned pressures. */
OstStatus ost_local_schur_add(OstLocalSchur *local, const double *r, double *z);

#endif

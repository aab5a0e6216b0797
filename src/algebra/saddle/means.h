/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_MEANS_H
#define ORTHOSTAT_ALGEBRA_SADDLE_MEANS_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/saddle/coupling.h"

/* What ost_coupling_schur_solve does not know of soft inclusions: their mean pressures are held by the stiff body
 * around them alone, at the ratio of the moduli of what S is taken for. Z (Z'S Z)^-1 Z' is added to it, where Z has a
 * column for each soft part (parts.h), 1 in the part, and A in S is replaced by its preconditioner. */
typedef struct OstSoftMeans OstSoftMeans;

/* Collective. One application of the preconditioner for each part; *means is NULL where there is no soft one. */
OstStatus ost_soft_means_create(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                                const OstCoupling *coupling, OstSoftMeans **means);
void ost_soft_means_destroy(OstSoftMeans **means);

/* Collective. z = z + Z (Z'S Z)^-1 Z' r, of owned pressures. */
OstStatus ost_soft_means_add(const OstSoftMeans *means, const double *r, double *z);

#endif

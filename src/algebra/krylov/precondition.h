/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_PRECONDITION_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_PRECONDITION_H

#include "algebra/krylov/preconditioner.h"

/* Collective. z = S^T M^-1 S r in unscaled unknowns; r of any size. `scaled` is work space; all have 3 × rows numbers.
 */
OstStatus ost_precondition(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *r,
                           double *scaled, double *z);

#endif

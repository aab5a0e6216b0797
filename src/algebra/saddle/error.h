/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_ERROR_H
#define ORTHOSTAT_ALGEBRA_SADDLE_ERROR_H

#include "algebra/saddle/saddle.h"

/* Collective. About the error of u and p that residuals of both equations leave, by one application of the
 * preconditioner, N = M / scale as ost_saddle_solve has ended with: up to 1 over its smallest eigenvalue too little.
 * The saddle has the second residual for g; its p becomes the error of p. */
OstStatus ost_saddle_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                           double scale, const double *r_u, double *e_u);

/* Collective. The same by the iteration of ost_saddle_solve, until so large a part of it is missing, in the norm of the
 * energy. `scale` as above, or 0. e_u and saddle->p are 0 on entry. *found: 0 if that fails. */
OstStatus ost_saddle_iterated_error(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                                    const OstSaddle *saddle, double scale, double missing, const double *r_u,
                                    double *e_u, int *found);

#endif

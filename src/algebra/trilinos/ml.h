/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_ML_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_ML_H

#include "algebra/matrix/block_matrix.h"

#include <ml_include.h>

/* The data of ML's callbacks: a block matrix, and a vector with room for its ghosts. Must outlive the ML object. */
typedef struct OstMlMatrix {
    const OstBlockMatrix *matrix;
    double *vector;   /* 3 × columns */
    OstStatus status; /* the first failure inside a callback, as ML cannot pass it on; see ost_ml_check */
} OstMlMatrix;

/* Local. An ML object over the context's communicator, silent, with room for `levels` levels; ML_Destroy frees it. */
OstStatus ost_ml_create(OstContext *ctx, int levels, ML **ml);

/* Collective. Passes `matrix` to ML as the operator of `level`, by callbacks for rows, product and halo exchange; ML
 * copies only the diagonal, so the matrix must outlive it. Free the link after ML_Destroy. Raises OST_LIMIT_EXCEEDED if
 * ML's 32-bit numbers are too small. */
OstStatus ost_ml_set_matrix(ML *ml, int level, const OstBlockMatrix *matrix, OstMlMatrix **link);
void ost_ml_matrix_destroy(OstMlMatrix **link);

/* Collective. Fails on all ranks if a callback has failed on any. */
OstStatus ost_ml_check(const OstMlMatrix *link);

#endif

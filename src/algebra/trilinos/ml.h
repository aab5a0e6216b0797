/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_ML_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_ML_H

#include "algebra/matrix/block_matrix.h"

#include <ml_include.h>

/* What ML calls back with: a block matrix, and a vector with room for its ghosts. Lives as long as the ML object. */
typedef struct OstMlMatrix {
    const OstBlockMatrix *matrix;
    double *vector;   /* 3 × columns */
    OstStatus status; /* the first failure inside a callback, which ML has no way to pass on; see ost_ml_check */
} OstMlMatrix;

/* Local. An ML object over the context's communicator, silent, with room for `levels` levels; ML_Destroy frees it. */
OstStatus ost_ml_create(OstContext *ctx, int levels, ML **ml);

/* Collective. Gives `matrix` to ML as the operator of `level`: rows on demand, product, diagonal, halo exchange. ML
 * copies nothing, so the matrix stays in place. Free the link after ML_Destroy. Raises OST_LIMIT_EXCEEDED where ML's
 * 32-bit numbers do not reach. */
OstStatus ost_ml_set_matrix(ML *ml, int level, const OstBlockMatrix *matrix, OstMlMatrix **link);
void ost_ml_matrix_destroy(OstMlMatrix **link);

/* Collective. The first failure of the callbacks since the link was made, on any rank. */
OstStatus ost_ml_check(const OstMlMatrix *link);

#endif

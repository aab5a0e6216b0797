/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/precondition.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"

#include <string.h>

OstStatus ost_precondition(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *r,
                           double *scaled, double *z)
{
    const size_t n = 3 * (size_t)system->matrix->rows;
    double size;
    if (system->scaling)
        ost_scaling_to_scaled(system->scaling, r, scaled);
    else if (n > 0)
        memcpy(scaled, r, n * sizeof *r);
    OST_TRY(ost_vector_size(system->matrix->ctx, n, scaled, &size));
    for (size_t i = 0; i < n; i++)
        scaled[i] /= size;
    OST_TRY(preconditioner->apply(preconditioner->data, scaled, z));
    if (system->scaling)
        ost_scaling_from_scaled(system->scaling, z, z);
    for (size_t i = 0; i < n; i++)
        z[i] *= size;
    return OST_SUCCESS;
}

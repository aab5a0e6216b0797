/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_LINEARITY_H
#define ORTHOSTAT_GUARD_LINEARITY_H

#include "assembly/batch.h"

/* The largest strain and rotation, which linear theory takes as small. Both are of a tet's mean displacement gradient:
 * the largest principal strain, and the angle of its antisymmetric part in radians. Where rotations are
 * large, the eigenvalue of U - I and the angle of R instead. */
typedef struct OstLinearity {
    double strain, rotation;
} OstLinearity;

/* Local. Raises `largest` to the strains and rotations of these tets under the displacement u. NaN is ignored: another
 * check finds it. */
void ost_linearity_add(const OstBatch *batch, const OstElement *element, OstFormulation formulation, const OstSimd *u,
                       const OstMeans *means, OstLinearity *largest);

/* Collective. Those of a displacement (3 × node_count) by linear theory. */
OstStatus ost_linearity_of(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstLinearity *largest);

/* Collective. The largest over all ranks. */
OstStatus ost_linearity_agree(OstContext *ctx, OstLinearity *largest);

#endif

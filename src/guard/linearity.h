/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_LINEARITY_H
#define ORTHOSTAT_GUARD_LINEARITY_H

#include "assembly/batch.h"

/* How small strains and rotations are, which linear theory takes as small. Both are of a tet's mean displacement
 * gradient: the largest principal strain, and the angle of its antisymmetric part in radians. */
typedef struct OstLinearity {
    double strain, rotation;
} OstLinearity;

/* Local. Raises `largest` to what these tets do under the displacement u. What is no number counts as nothing: another
 * check tells that. */
void ost_linearity_add(const OstBatch *batch, const OstElement *element, const OstLanes *u, const OstMeans *means,
                       OstLinearity *largest);

/* Collective. The largest over all ranks. */
OstStatus ost_linearity_agree(OstContext *ctx, OstLinearity *largest);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_LINEARITY_H
#define ORTHOSTAT_GUARD_LINEARITY_H

#include "assembly/batch.h"
#include "assembly/supports.h"

/* The largest strain and rotation, which linear theory takes as small. Both are of a tet's mean displacement gradient:
 * the largest principal strain, and the angle of its antisymmetric part in radians. Where rotations are
 * large, the eigenvalue of U - I and the angle of R instead. By linear theory also two energies: that of the strain and
 * of the springs, and that of the stress on what U - I has beyond the strain to second order, ½ (H'H - e²) with
 * H = grad u. The second over the first is how much stiffer stress makes the body as it turns (a bar that bends under
 * tension), or softer (under compression). */
typedef struct OstLinearity {
    double strain, rotation, energy, stiffening;
} OstLinearity;

/* The second energy over the first, 0 of a body without any. */
static inline double ost_linearity_stiffening(const OstLinearity *all)
{
    return all->energy > 0.0 ? all->stiffening / all->energy : 0.0;
}

/* Local. Raises `largest` to the strains and rotations of these tets under the displacement u. NaN is ignored: another
 * check finds it. */
void ost_linearity_add(const OstBatch *batch, const OstElement *element, OstFormulation formulation, const OstSimd *u,
                       const OstMeans *means, OstLinearity *largest);

/* Collective. Those of a displacement (3 × node_count) by linear theory, with t times the eigenstrain. */
OstStatus ost_linearity_of(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                           const OstSupports *supports, OstLinearity *largest);

/* Collective. The largest over all ranks; the energies of all tets, and of the springs under u. */
OstStatus ost_linearity_agree(OstContext *ctx, const OstSupports *supports, const double *u, OstLinearity *largest);

#endif

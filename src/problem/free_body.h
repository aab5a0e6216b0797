/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_FREE_BODY_H
#define ORTHOSTAT_PROBLEM_FREE_BODY_H

#include "assembly/supports.h"
#include "problem/result_data.h"

/* An unconstrained body under loads that balance each other. Six components at three vertices are constrained, which is
 * just enough, so their reactions are zero; then rigid motion is taken out of the answer. OST_EFFECT_FREE_BODY. */

/* Collective. Supports at three vertices far apart: the first constrained in all directions, the second across the line
 * from the first, the third across the plane of the three. */
OstStatus ost_free_body_supports(const OstMesh *mesh, const OstEffects *effects, OstSupports **supports);

/* Collective. Subtracts a rigid motion from a displacement (3 × node_count, ghosts filled) so that its mean over the
 * volume, and that of its rotation (half its curl), are zero. */
OstStatus ost_free_body_centre(const OstMesh *mesh, double *displacement);

#endif

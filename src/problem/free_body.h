/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_FREE_BODY_H
#define ORTHOSTAT_PROBLEM_FREE_BODY_H

#include "assembly/supports.h"
#include "problem/result_data.h"

/* A body that nothing holds, under loads that balance each other: it is held at six components of three vertices, just
 * enough (so that they carry nothing), and its rigid motion is taken out of the answer. OST_EFFECT_FREE_BODY. */

/* Collective. Supports that hold three vertices far apart: one in all directions, one across the line to the first, one
 * across the plane of the three. */
OstStatus ost_free_body_supports(const OstMesh *mesh, const OstEffects *effects, OstSupports **supports);

/* Collective. Takes from a displacement (3 × node_count, ghosts filled) the rigid motion that leaves its mean over the
 * volume, and that of its rotation (half its curl), at zero. */
OstStatus ost_free_body_centre(const OstMesh *mesh, double *displacement);

#endif

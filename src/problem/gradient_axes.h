/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_GRADIENT_AXES_H
#define ORTHOSTAT_PROBLEM_GRADIENT_AXES_H

#include "problem/scene_data.h"

/* Collective. Axes from two harmonic potentials. Each is 0 on its boundary `from`, 1 on its boundary `to`, and has no
 * flux elsewhere. e1 is the gradient of the first; e2 is the part of the second's orthogonal to e1. Both are solved at
 * once, as components of a displacement, by the solver of the elastic problem. Fills `axes` (9 a tet) for the region's
 * tets. Account OST_EFFECT_GRADIENT_AXES. */
OstStatus ost_scene_gradient_axes(const OstScene *scene, int region, const OstAxesSpec *spec, double *axes);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_GRADIENT_AXES_H
#define ORTHOSTAT_PROBLEM_GRADIENT_AXES_H

#include "problem/scene_data.h"

/* Collective. Axes from two harmonic potentials: each is 0 on its boundary `from`, 1 on its boundary `to`, and has no
 * flux elsewhere; e1 follows the gradient of the first, e2 what of the second's is orthogonal to it. Both are solved at
 * once, as components of a displacement, with the solver of the elastic problem. Fills given_axes (9 a tet) for the
 * region's tets. Account OST_EFFECT_GRADIENT_AXES. */
OstStatus ost_scene_gradient_axes(const OstScene *scene, int region, const OstAxesSpec *spec, double *given_axes);

#endif

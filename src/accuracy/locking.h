/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LOCKING_H
#define ORTHOSTAT_ACCURACY_LOCKING_H

#include "problem/problem.h"

/* Local. Is a material of the body nearly incompressible? */
int ost_is_nearly_incompressible(const OstProblem *problem);

/* Collective. Do stiff directions cross the edges of the tets? Linear tets then lock. Measured is the squared length in
 * the material metric of a unit step along the stiffest edge of a tet, over that along the stiff direction; where two
 * directions are as stiff, that of the second stiffest edge. Its mean over some 10,000 tets is 1 to 1.2 in meshes that
 * follow the axes, and for isotropic bodies. */
OstStatus ost_stiff_directions_cross(const OstProblem *problem, int *cross);

/* Collective. Do more than 45 % of the vertices lie at the surface, as in plates and walls of up to three layers of
 * tets, which bend as if they were stiffer, and in any coarse body? `edges`: those that are this rank's. */
OstStatus ost_has_few_layers(const OstMesh *mesh, OstLocal edges, int *few);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LINEAR_TETS_H
#define ORTHOSTAT_ACCURACY_LINEAR_TETS_H

#include "accuracy/complement.h"

/* Linear tets with a uniform C and the quadratic functions of their edges, by linear theory: the stress is linear, and
 * known at the vertices. C comes as the 21 numbers, or as a stretch tensor (element/elasticity.h). */

/* Local. Forces of a displacement u of the nodes, and w of the functions; w may be NULL, and is quicker so. */
void ost_linear_tets_forces(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, const OstSimd *w,
                            OstSimd *at_nodes, OstSimd *at_functions);

/* Local. The functions' own 3×3 blocks of the stiffness. */
void ost_linear_tets_blocks(const OstSimd *x, const OstElasticity *elasticity, OstSimd block[OST_MAX_FUNCTIONS][9]);

#endif

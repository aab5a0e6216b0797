/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LINEAR_TETS_H
#define ORTHOSTAT_ACCURACY_LINEAR_TETS_H

#include "accuracy/complement/complement.h"

/* Linear tets with the quadratic functions of their edges, by linear theory. C comes as the 21 numbers, or as a stretch
 * tensor (element/elasticity.h). */

/* Local. Forces of a displacement u of the nodes, less those of the eigenstrain. `rule` has the points of C if it
 * varies; where it does about a line, elasticity->stretch_at has A there. */
void ost_linear_tets_forces(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule,
                            const OstSimd *u, OstSimd *at_nodes, OstSimd *at_functions);

/* Local. The functions' own 3×3 blocks of the stiffness with a uniform C. */
void ost_linear_tets_blocks(const OstSimd *x, const OstElasticity *elasticity, OstSimd block[OST_MAX_FUNCTIONS][9]);

#endif

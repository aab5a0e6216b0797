/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_EXACT_TET_H
#define HARD_GRID_EXACT_TET_H

#include "assembly/batch.h"

typedef long double Long;

/* Local. Forces (3 × nodes) and mean stress of one tet of a batch, under displacements relative to its first node (3 ×
 * nodes) and, of a mixed form, pressures at its vertices; `volume`: what they leave of each pressure's equation. All
 * but the displacements may be NULL. */
void hard_exact_tet(const OstBatch *batch, int slot, int nodes, const Long *u, const Long pressure[4], Long *force,
                    Long stress[6], Long volume[4]);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_EXACT_TET_H
#define HARD_GRID_EXACT_TET_H

#include "assembly/batch.h"
#include "assembly/supports.h"
#include "hard_grid/twofold.h"

typedef long double Long;

/* Local. Forces (3 × nodes) and mean stress of one tet of a batch, under displacements relative to its first node (3 ×
 * nodes) and, of a mixed form, pressures at its vertices; `volume`: what they leave of each pressure's equation. All
 * but the displacements may be NULL. */
void hard_exact_tet(const OstBatch *batch, int slot, int nodes, const Long *u, const Long pressure[4], Long *force,
                    Long stress[6], Long volume[4]);

/* Local. S u of a node's springs, along one direction. */
Long hard_spring_force(const OstSupports *supports, size_t node, size_t i, const Twofold *u);

/* Reactions may be none: their error is over no less than this share of the loads, as the program states it. */
extern const double hard_least_reaction;

#endif

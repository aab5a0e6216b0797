/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_RAISE_H
#define ORTHOSTAT_MESH_REFINEMENT_RAISE_H

#include "mesh/refinement/mid_nodes.h"

/* Collective. The quadratic mesh on mid-edge nodes whose positions are set. */
OstStatus ost_mesh_raise_over(const MidNodes *mid, OstMesh **quadratic);

#endif

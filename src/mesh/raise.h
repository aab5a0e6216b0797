/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_RAISE_H
#define ORTHOSTAT_MESH_RAISE_H

#include "mesh/mid_nodes.h"

/* Collective. The quadratic mesh over new nodes that are already placed. */
OstStatus ost_mesh_raise_over(const MidNodes *mid, OstMesh **quadratic);

/* Collective. Raises OST_INVALID_INPUT, with the label, if a quadratic tet folds over at one of its vertices. */
OstStatus ost_check_folds(const OstMesh *quadratic);

#endif

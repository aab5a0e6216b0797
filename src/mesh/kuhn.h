/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_KUHN_H
#define ORTHOSTAT_MESH_KUHN_H

#include "orthostat/mesh.h"

enum { KUHN_TETS = 6, KUHN_CORNERS = 8 };

/* A hex divided in six tets along the diagonal from corner 0 to corner 7 (Kuhn). Corner numbers are bits: 1 for a step
 * in the first direction, 2 in the second, 4 in the third, which form a right-handed system. Neighbours match if the
 * diagonals of the face they share do. */

/* Local. Writes the 24 nodes of the tets; returns the place after. */
OstGlobal *ost_kuhn_tets(const OstGlobal corner[KUHN_CORNERS], OstGlobal *node);

/* Local. Writes the 6 nodes of the two faces that lie at one end (high: 0 or 1) of a direction, outward; returns the
 * place after. */
OstGlobal *ost_kuhn_faces(const OstGlobal corner[KUHN_CORNERS], int direction, int high, OstGlobal *node);

/* Local. This rank's share of `total` cells or nodes: contiguous, and equal to within one. Raises OST_LIMIT_EXCEEDED if
 * a rank could not number their tets. */
OstStatus ost_kuhn_share(OstContext *ctx, const char *shape, const char *what, OstGlobal total, OstGlobal *first,
                         OstLocal *count);

#endif

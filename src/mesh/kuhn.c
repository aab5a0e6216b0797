/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/kuhn.h"

#include "core/error.h"
#include "mesh/tet.h"

/* The paths from corner 000 to corner 111 along the edges of a cell: one tet for each order of the three directions.
 * Odd orders have their second and last vertices swapped, so that every tet is positively oriented; the middles of its
 * edges 02 and 13 stay those between which its inner octahedron is cut (see refine.c). */
static const int kuhn_corner[KUHN_TETS][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                              {0, 7, 5, 1}, {0, 7, 6, 4}, {0, 7, 3, 2}};

OstGlobal *ost_kuhn_tets(const OstGlobal corner[KUHN_CORNERS], OstGlobal *node)
{
    for (int t = 0; t < KUHN_TETS; t++)
        for (int v = 0; v < 4; v++)
            *node++ = corner[kuhn_corner[t][v]];
    return node;
}

OstGlobal *ost_kuhn_faces(const OstGlobal corner[KUHN_CORNERS], int direction, int high, OstGlobal *node)
{
    for (int t = 0; t < KUHN_TETS; t++) {
        int away = 0;
        int opposite = -1;
        for (int v = 0; v < 4; v++) {
            if ((kuhn_corner[t][v] >> direction & 1) != high) {
                away++;
                opposite = v;
            }
        }
        if (away == 1)
            for (int v = 0; v < 3; v++)
                *node++ = corner[kuhn_corner[t][ost_tet_face[opposite][v]]];
    }
    return node;
}

OstStatus ost_kuhn_share(OstContext *ctx, const char *shape, const char *what, OstGlobal total, OstGlobal *first,
                         OstLocal *count)
{
    const int size = ost_size(ctx);
    const OstGlobal each = total / size;
    const OstGlobal rest = total % size;
    const OstGlobal rank = ost_rank(ctx);
    if (each >= INT32_MAX / KUHN_TETS)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "%s: %lld %s on %d rank%s are more than the %d that one rank can number; use more ranks",
                         shape, (long long)total, what, size, size == 1 ? "" : "s", INT32_MAX / KUHN_TETS);
    *first = rank * each + (rank < rest ? rank : rest);
    *count = (OstLocal)(each + (rank < rest ? 1 : 0));
    return OST_SUCCESS;
}

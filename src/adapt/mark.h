/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_MARK_H
#define ORTHOSTAT_ADAPT_MARK_H

#include "mesh/mesh_data.h"

/* How often each tet is to be cut. The shares of the new tets in the squared error are to be about equal, since so the
 * fewest tets have a given error. A cut of smooth functions leaves 2^-(2 order / 3 + 1) of a tet's share in each child;
 * at corners, edges and forces at points it leaves more, which is learnt from the cuts before. */
typedef struct OstMarking {
    int order;
    double target;          /* of the squared error over all tets */
    double least_share;     /* what each tet of a mesh that meets the target has: no tet need have less */
    double least_tets;      /* as many at least, by what is expected, if cuts of one level can make them */
    double most_tets;       /* as many at most */
    double expected_tets;   /* found: tets of the new mesh, less those that are cut only for others' sake */
    double expected_square; /* found: the squared error */
} OstMarking;

/* The most cuts of a tet in one level: edges of half the length. */
enum { OST_MOST_CUTS = 3 };

/* Local. By which power of 1/2 a child's share falls in one cut of a tet, where the solution is smooth. */
double ost_smooth_fall(int order);

/* Local. The same as it was found, from the share of a tet that was cut `cuts` times, and that of the child. */
double ost_found_fall(int order, double before, double after, int cuts);

/* Collective. `error`: each own tet's share of the squared error; `fall` of each, expected of its next cuts; `times`:
 * owned_tets numbers of the caller. */
OstStatus ost_mark(const OstMesh *mesh, const double *error, const double *fall, OstMarking *marking,
                   unsigned char *times);

#endif

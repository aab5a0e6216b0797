/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_MARK_H
#define ORTHOSTAT_ADAPT_MARK_H

#include "mesh/mesh_data.h"

/* How often each tet is to be cut. `error` is each own tet's share of the squared error, `order` that of the elements:
 * a cut of smooth functions is expected to leave 2^(-2 order / 3) of a tet's share, half in each child. The shares of
 * the new tets are to be about equal, since so the fewest tets have a given error. */
typedef struct OstMarking {
    int order;
    double target;          /* of the squared error over all tets */
    double most_tets;       /* as many at most, by what is expected */
    double expected_tets;   /* found: tets of the new mesh, less those that are cut only for others' sake */
    double expected_square; /* found: the squared error */
} OstMarking;

/* The most cuts of a tet in one level: edges of a quarter of the length. What is seen of the error there says little
 * about smaller ones. */
enum { OST_MOST_CUTS = 6 };

/* Collective. `times`: owned_tets numbers of the caller. */
OstStatus ost_mark(const OstMesh *mesh, const double *error, OstMarking *marking, unsigned char *times);

#endif

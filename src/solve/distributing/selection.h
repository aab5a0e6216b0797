/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_DISTRIBUTING_SELECTION_H
#define ORTHOSTAT_SOLVE_DISTRIBUTING_SELECTION_H

#include "problem/problem.h"

/* What one coupling moves, and its motion as a function of sums over it (turned.h). */
enum { OST_MOST_SUMS = 12, OST_MOST_GIVEN = 6 };

typedef struct OstMovedSelection {
    const OstLoad *load;
    double *share, *arm; /* of owned nodes: the mean displacement's weights; integrals of N (X - c), along the axes */
    double axis[9];      /* principal axes of the selection as rows, the longest first, */
    double extent[3];    /* and its second moments along them */
    double area;         /* or the number of vertices */
    double point[3];     /* from the centroid c */
    int sums;            /* 3 + 3 × axes along which it extends: the mean displacement, and F along these */
    int turns_wholly;    /* are all components of its rotation given? */
    int count, component[OST_MOST_GIVEN];
    double given[OST_MOST_GIVEN]; /* now */
} OstMovedSelection;

/* A row of Y: the weight of a sum at an owned node is of one component of its displacement. */
static inline double ost_moved_selection_weight(const OstMovedSelection *coupling, int sum, size_t node)
{
    return sum < 3 ? coupling->share[node] : coupling->arm[3 * node + (size_t)(sum / 3 - 1)];
}

/* Collective. Of a load of the scene; `force` has room for 3 × node_count. */
OstStatus ost_moved_selection_open(const OstScene *scene, int load, double *force, OstMovedSelection *selection);
void ost_moved_selection_close(OstMovedSelection *selection);

/* Local. At its sums z, with multipliers x: what the given components lack, their derivative by the sums (rows of
 * `width`), h, and h_z (likewise). */
OstStatus ost_moved_selection_state(OstContext *ctx, const OstMovedSelection *selection, const double *z,
                                    const double *x, int width, double *lack, double *slope, double *h, double *bend);

#endif

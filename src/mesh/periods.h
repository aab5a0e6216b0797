/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_PERIODS_H
#define ORTHOSTAT_MESH_PERIODS_H

#include "mesh/mesh_data.h"
#include "orthostat/refine.h"

/* A node of a leading boundary, of any rank. Mid-edge nodes are known by the place halfway between the edge's ends:
 * where an edge is made straight on one side alone, they still are each other's images. */
typedef struct OstPeriodicNode {
    double x[3];  /* by which it is known */
    double at[3]; /* where it is */
    OstGlobal number, label;
    int follows; /* is it on a boundary that follows, too? */
} OstPeriodicNode;

/* Pairs of boundaries that are the same but for a shift, and which of them each node is on. */
enum { OST_MOST_PERIODS = 32 };
typedef struct OstPeriods {
    const OstMesh *mesh;
    int count;
    double period[OST_MOST_PERIODS][3]; /* from the leading boundary to the one that follows */
    double *place;                      /* 3 × node_count: by which each node is known */
    double within;                      /* how far a node may be from its place */
    uint32_t *leads, *follows;          /* node_count: bits of the pairs */
    OstLocal nodes;
    OstPeriodicNode *node; /* by x */
} OstPeriods;

/* Collective. Raises OST_INVALID_INPUT for boundaries that are not there, that have no nodes or lie in one place,
 * OST_LIMIT_EXCEEDED for more than OST_MOST_PERIODS pairs. */
OstStatus ost_periods_create(const OstMesh *mesh, int count, const OstPeriodicPair *pair, OstPeriods **periods);
void ost_periods_destroy(OstPeriods **periods);

/* Local. Where a place is once it has gone back by the periods of some pairs. */
void ost_periods_back(const OstPeriods *periods, uint32_t pairs, const double x[3], double back[3]);

/* Local. The node of a leading boundary that is known by a place, one that follows none if there are several; or NULL.
 */
const OstPeriodicNode *ost_periods_find(const OstPeriods *periods, const double x[3]);

/* Local. The first of `count` structs of `size` bytes that begin with a place, sorted by its x, whose x is not less
 * than this one; and are two places the same within a distance? */
OstLocal ost_first_by_x(OstLocal count, size_t size, const void *items, double x);
int ost_is_same_place(const double a[3], const double b[3], double within);

#endif

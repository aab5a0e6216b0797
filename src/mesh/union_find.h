/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_UNION_FIND_H
#define ORTHOSTAT_MESH_UNION_FIND_H

#include "orthostat/context.h"

/* Sets of numbered things as trees: parent[i] is i for a set's root, which is its lowest number. */

static inline OstLocal ost_set_root(OstLocal *parent, OstLocal i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]]; /* halves the path for the next search */
        i = parent[i];
    }
    return i;
}

static inline void ost_set_join(OstLocal *parent, OstLocal a, OstLocal b)
{
    a = ost_set_root(parent, a);
    b = ost_set_root(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

static inline void ost_set_start(OstLocal *parent, OstLocal count)
{
    for (OstLocal i = 0; i < count; i++)
        parent[i] = i;
}

/* Numbers the sets from 0 in the order of their roots, in place: set[i] becomes the number of i's set. Returns the
 * number of sets. */
static inline OstLocal ost_set_number(OstLocal *set, OstLocal count)
{
    OstLocal sets = 0;
    for (OstLocal i = 0; i < count; i++)
        set[i] = set[i] == i ? sets++ : set[set[i]]; /* a parent comes before i, so it has its number already */
    return sets;
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/incidence.h"

#include "core/error.h"
#include "core/memory.h"

void ost_incidence_clear(Incidence *incidence)
{
    OST_FREE(incidence->start, incidence->tet);
}

OstStatus ost_incidence_build(OstContext *ctx, OstLocal node_count, OstLocal tet_count, int nodes_per_tet,
                              const OstLocal *tet_nodes, Incidence *incidence)
{
    const size_t width = (size_t)nodes_per_tet;
    const size_t entries = (size_t)tet_count * width;
    OST_TRY(OST_NEW(ctx, &incidence->start, (size_t)node_count + 2));
    OstGlobal *next = incidence->start + 1; /* offset by one: filling the lists moves each start to its place */
    for (size_t i = 0; i < entries; i++)
        if (tet_nodes[i] < node_count)
            next[tet_nodes[i] + 1]++;
    for (OstLocal n = 0; n < node_count; n++)
        next[n + 1] += next[n];
    OST_TRY(OST_NEW(ctx, &incidence->tet, next[node_count]));
    for (size_t i = 0; i < entries; i++)
        if (tet_nodes[i] < node_count)
            incidence->tet[next[tet_nodes[i]]++] = (OstLocal)(i / width);
    return OST_SUCCESS;
}

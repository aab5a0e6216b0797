/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/row_parts.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"

static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

static OstStatus number_own(const OstLocal *row_of_node, OstGlobal first_row, OstRowNumbers *numbers)
{
    const OstLinks *links = numbers->links;
    OST_TRY(OST_NEW(links->ctx, &numbers->of_node, links->mesh->node_count));
    OST_TRY(OST_NEW(links->ctx, &numbers->of_leader, links->slots));
    for (OstLocal n = 0; n < links->mesh->owned_nodes; n++) {
        numbers->of_leader[n] = row_of_node[n] < 0 ? -1 : first_row + row_of_node[n];
        numbers->of_node[n] = links->of_node[n] >= 0 ? -1 : numbers->of_leader[n];
    }
    return OST_SUCCESS;
}

OstStatus ost_row_numbers_create(const OstLinks *links, const OstLocal *row_of_node, OstGlobal first_row,
                                 OstRowNumbers *numbers)
{
    *numbers = (OstRowNumbers){.links = links};
    OstStatus status = ost_agree(links->ctx, number_own(row_of_node, first_row, numbers));
    OST_THEN(ost_halo_import(links->mesh->halo, sizeof *numbers->of_node, numbers->of_node));
    OST_THEN(ost_halo_import(links->halo, sizeof *numbers->of_leader, numbers->of_leader));
    return ost_agree(links->ctx, status);
}

void ost_row_numbers_clear(OstRowNumbers *numbers)
{
    OST_FREE(numbers->of_node, numbers->of_leader);
}

void ost_row_parts(const OstRowNumbers *numbers, OstLocal node, OstRowParts *parts)
{
    const OstLink *link = ost_link_of(numbers->links, node);
    parts->count = link ? link->count : 1;
    parts->row[0] = numbers->of_node[node];
    parts->weight[0] = identity;
    for (int k = 0; link && k < link->count; k++) {
        parts->row[k] = numbers->of_leader[link->slot[k]];
        parts->weight[k] = link->leader[k].weight;
    }
}

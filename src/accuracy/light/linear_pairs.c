/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/pairs.h"
#include "core/kernel.h"
#include "element/strain_batch.h"

typedef Sixteen Number;
#define FROM OST_FOR_BOTH
#include "accuracy/light/linear_kernel.h"

static inline void apply(const OstLightTets *tets, size_t k, int by_stretch, const Pair *pair)
{
    const Eights *eights = &tets->eights[k];
    Sixteen moved[VERTICES][3], w[EDGES][3], at_nodes[VERTICES][3], at_functions[EDGES][3];
    Linear tet;
    open_linear(eights, tets->elastic + numbers_kept[tets->keeping] * k, by_stretch, &tet);
    for (int v = 1; v < VERTICES; v++)
        read_node_pair(tets, eights, pair, v, moved[v]);
    for (int e = 0; e < EDGES; e++)
        read_function_pair(tets, eights, pair, e, w[e]);
    find_forces(&tet, moved + 1, w, at_nodes + 1, at_functions);
    add_nodes_pair(tets, eights, pair, VERTICES, at_nodes);
    for (int e = 0; e < EDGES; e++)
        add_function_pair(tets, eights, pair, e, at_functions[e]);
}

OST_KERNEL void ost_linear_pairs_apply(const OstLightTets *tets, const Pair *pair)
{
    for (size_t k = 0; k < tets->count; k++) {
        if (tets->keeping == KEEP_STRETCH)
            apply(tets, k, 1, pair);
        else
            apply(tets, k, 0, pair);
    }
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/pairs.h"
#include "core/kernel.h"
#include "element/strain_batch.h"

typedef Sixteen Number;
#define FROM OST_FOR_BOTH
#include "accuracy/light/linear_kernel.h"

typedef struct Moved {
    Sixteen nodes[VERTICES][3], functions[EDGES][3];
} Moved;

static inline void find_pair(const OstLightTets *tets, size_t k, int by_stretch, const Pair *pair, Places *places,
                             Moved *moved, Moved *forces)
{
    const Eights *eights = &tets->eights[k];
    Linear tet;
    open_linear(eights, tets->elastic + numbers_kept[tets->keeping] * k, by_stretch, &tet);
    find_pair_places(tets, eights, VERTICES, EDGES, places);
    for (int v = 1; v < VERTICES && !pair->at_rest; v++)
        read_node_pair(places, pair, v, moved->nodes[v]);
    for (int e = 0; e < EDGES; e++)
        read_function_pair(places, pair, e, moved->functions[e]);
    find_forces(&tet, moved->nodes + 1, moved->functions, forces->nodes + 1, forces->functions);
}

OST_KERNEL void ost_linear_pairs_apply(const OstLightTets *tets, const Pair *pair)
{
    Moved moved = {0}, forces;
    Places places;
    for (size_t k = 0; k < tets->count; k++) {
        if (tets->keeping == KEEP_STRETCH)
            find_pair(tets, k, 1, pair, &places, &moved, &forces);
        else
            find_pair(tets, k, 0, pair, &places, &moved, &forces);
        add_nodes_pair(&places, pair, VERTICES, forces.nodes);
        for (int e = 0; e < EDGES; e++)
            add_function_pair(&places, pair, e, forces.functions[e]);
    }
}

OST_KERNEL void ost_linear_pairs_energy(const OstLightTets *tets, const Pair *pair)
{
    Moved moved = {0}, forces;
    Places places;
    for (size_t k = 0; k < tets->count; k++) {
        Sixteen work = {0.0F};
        find_pair(tets, k, tets->keeping == KEEP_STRETCH, pair, &places, &moved, &forces);
        add_work(VERTICES - 1, moved.nodes + 1, forces.nodes + 1, &work);
        add_work(EDGES, moved.functions, forces.functions, &work);
        keep_energies(tets, &tets->eights[k], &work, pair);
    }
}

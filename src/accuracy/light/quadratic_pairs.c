/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/pairs.h"
#include "core/kernel.h"

typedef Sixteen Number;
#define FROM OST_FOR_BOTH
#include "accuracy/light/quadratic_kernel.h"

typedef int32_t PairBits __attribute__((vector_size(PAIR * WIDTH * sizeof(int32_t))));

static inline void turn(const Bits *turns, Sixteen of_function[3])
{
    const PairBits both = __builtin_shufflevector(*turns, *turns, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
    for (int i = 0; i < 3; i++)
        of_function[i] = (Sixteen)((PairBits)of_function[i] ^ both);
}

typedef struct Moved {
    Sixteen nodes[NODES][3], functions[FUNCTIONS][3];
} Moved;

static inline void find_pair(const OstLightTets *tets, size_t k, const Pair *pair, const Bits turns[EDGES],
                             Places *places, Moved *moved, Moved *forces)
{
    find_pair_places(tets, &tets->eights[k], NODES, FUNCTIONS, places);
    for (int a = 1; a < NODES && !pair->at_rest; a++)
        read_node_pair(places, pair, a, moved->nodes[a]);
    for (int n = 0; n < FUNCTIONS; n++) {
        read_function_pair(places, pair, n, moved->functions[n]);
        if (n < EDGES)
            turn(&turns[n], moved->functions[n]);
    }
    find_forces(tets, k, moved->nodes, moved->functions, forces->nodes, forces->functions);
}

OST_KERNEL void ost_quadratic_pairs_apply(const OstLightTets *tets, const Pair *pair)
{
    Moved moved = {0}, forces;
    Places places;
    for (size_t k = 0; k < tets->count; k++) {
        Bits turns[EDGES];
        find_turns(tets, &tets->eights[k], turns);
        find_pair(tets, k, pair, turns, &places, &moved, &forces);
        add_nodes_pair(&places, pair, NODES, forces.nodes);
        for (int n = 0; n < FUNCTIONS; n++) {
            if (n < EDGES)
                turn(&turns[n], forces.functions[n]);
            add_function_pair(&places, pair, n, forces.functions[n]);
        }
    }
}

OST_KERNEL void ost_quadratic_pairs_energy(const OstLightTets *tets, const Pair *pair)
{
    Moved moved = {0}, forces;
    Places places;
    for (size_t k = 0; k < tets->count; k++) {
        Sixteen work = {0.0F};
        Bits turns[EDGES];
        find_turns(tets, &tets->eights[k], turns);
        find_pair(tets, k, pair, turns, &places, &moved, &forces);
        add_work(NODES, moved.nodes, forces.nodes, &work);
        add_work(FUNCTIONS, moved.functions, forces.functions, &work);
        keep_energies(tets, &tets->eights[k], &work, pair);
    }
}

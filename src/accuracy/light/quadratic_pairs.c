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

OST_KERNEL void ost_quadratic_pairs_apply(const OstLightTets *tets, const Pair *pair)
{
    Sixteen moved[NODES][3] = {{{0.0F}}}, w[FUNCTIONS][3], at_nodes[NODES][3], at_functions[FUNCTIONS][3];
    for (size_t k = 0; k < tets->count; k++) {
        const Eights *eights = &tets->eights[k];
        Bits turns[EDGES];
        find_turns(tets, eights, turns);
        for (int a = 1; a < NODES; a++)
            read_node_pair(tets, eights, pair, a, moved[a]);
        for (int n = 0; n < FUNCTIONS; n++) {
            read_function_pair(tets, eights, pair, n, w[n]);
            if (n < EDGES)
                turn(&turns[n], w[n]);
        }
        find_forces(tets, k, moved, w, at_nodes, at_functions);
        add_nodes_pair(tets, eights, pair, NODES, at_nodes);
        for (int n = 0; n < FUNCTIONS; n++) {
            if (n < EDGES)
                turn(&turns[n], at_functions[n]);
            add_function_pair(tets, eights, pair, n, at_functions[n]);
        }
    }
}

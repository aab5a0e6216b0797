/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/quadratic.h"

#include "core/kernel.h"

typedef Eight Number;
#define FROM(kept) (kept)
#include "accuracy/light/quadratic_kernel.h"

/* --- reading and adding --- */

/* How nodes move from vertex 0. (In double precision: a rotation of the whole body is large.) */
static inline void read_nodes(const OstLightTets *tets, const Eights *eights, Eight moved[NODES][3])
{
    Four row[NODES][WIDTH];
    for (int slot = 0; slot < WIDTH; slot++) {
        const OstLocal *nodes = ost_mesh_nodes_of(tets->mesh, eights->tet[slot]);
        const Wide base = *(const Wide *)(tets->u + 4 * (size_t)nodes[0]);
        for (int a = 1; a < NODES; a++) {
            const Wide there = *(const Wide *)(tets->u + 4 * (size_t)nodes[a]);
            row[a][slot] = __builtin_convertvector(there - base, Four);
        }
    }
    moved[0][0] = moved[0][1] = moved[0][2] = (Eight){0.0F};
    for (int a = 1; a < NODES; a++)
        transpose(row[a], moved[a]);
}

/* Those on vertex 0 are what balances the others: in single precision they would not, and the whole body would move. */
static inline void add_to_nodes(OstLightTets *tets, const Eights *eights, Eight at_nodes[NODES][3])
{
    Four row[NODES][WIDTH];
    for (int a = 1; a < NODES; a++)
        transpose_back(at_nodes[a], row[a]);
    for (int slot = 0; slot < WIDTH; slot++) {
        const OstLocal *nodes = ost_mesh_nodes_of(tets->mesh, eights->tet[slot]);
        Wide sum = {0.0};
        for (int a = 1; a < NODES; a++) {
            const Wide force = __builtin_convertvector(row[a][slot], Wide);
            *(Wide *)(tets->force + 4 * (size_t)nodes[a]) += force;
            sum += force;
        }
        *(Wide *)(tets->force + 4 * (size_t)nodes[0]) -= sum;
    }
}

static inline void turn(const Bits *turns, Eight of_function[3])
{
    for (int i = 0; i < 3; i++)
        of_function[i] = (Eight)((Bits)of_function[i] ^ *turns);
}

static inline void read_functions(const OstLightTets *tets, const Eights *eights, const float *values,
                                  const Bits turns[EDGES], Eight w[FUNCTIONS][3])
{
    for (int k = 0; k < FUNCTIONS; k++) {
        Four row[WIDTH];
        for (int slot = 0; slot < WIDTH; slot++)
            row[slot] = *(const Four *)(values + OST_PER_FUNCTION * (size_t)function_of(tets, eights, slot, k));
        transpose(row, w[k]);
        if (k < EDGES)
            turn(&turns[k], w[k]);
    }
}

static inline void add_to_functions(const OstLightTets *tets, const Eights *eights, const Bits turns[EDGES],
                                    Eight at_functions[FUNCTIONS][3], float *of_functions)
{
    for (int k = 0; k < FUNCTIONS; k++) {
        Four row[WIDTH];
        if (k < EDGES)
            turn(&turns[k], at_functions[k]);
        transpose_back(at_functions[k], row);
        for (int slot = 0; slot < WIDTH; slot++)
            *(Four *)(of_functions + OST_PER_FUNCTION * (size_t)function_of(tets, eights, slot, k)) += row[slot];
    }
}

static inline void find_eight(const OstLightTets *tets, size_t k, const float *functions, const Bits turns[EDGES],
                              Eight moved[NODES][3], Eight w[FUNCTIONS][3], Eight at_nodes[NODES][3],
                              Eight at_functions[FUNCTIONS][3])
{
    read_nodes(tets, &tets->eights[k], moved);
    read_functions(tets, &tets->eights[k], functions, turns, w);
    find_forces(tets, k, moved, w, at_nodes, at_functions);
}

/* --- all tets --- */

OST_KERNEL void ost_quadratic_eights_apply(OstLightTets *tets, const float *functions, float *of_functions)
{
    Eight moved[NODES][3], w[FUNCTIONS][3], at_nodes[NODES][3], at_functions[FUNCTIONS][3];
    for (size_t k = 0; k < tets->count; k++) {
        Bits turns[EDGES];
        find_turns(tets, &tets->eights[k], turns);
        find_eight(tets, k, functions, turns, moved, w, at_nodes, at_functions);
        add_to_nodes(tets, &tets->eights[k], at_nodes);
        add_to_functions(tets, &tets->eights[k], turns, at_functions, of_functions);
    }
}

OST_KERNEL void ost_quadratic_eights_energy(const OstLightTets *tets, const float *functions, double *energy)
{
    Eight moved[NODES][3], w[FUNCTIONS][3], at_nodes[NODES][3], at_functions[FUNCTIONS][3];
    const OstLocal owned = tets->mesh->owned_tets;
    for (size_t k = 0; k < tets->count; k++) {
        const Eights *eights = &tets->eights[k];
        Eight sum = {0.0F};
        Bits turns[EDGES];
        find_turns(tets, eights, turns);
        find_eight(tets, k, functions, turns, moved, w, at_nodes, at_functions);
        for (int n = 0; n < 3 * NODES; n++)
            sum += moved[n / 3][n % 3] * at_nodes[n / 3][n % 3] + w[n / 3][n % 3] * at_functions[n / 3][n % 3];
        for (int slot = 0; slot < WIDTH; slot++)
            if (eights->volume[slot] != 0.0F && eights->tet[slot] < owned)
                energy[eights->tet[slot]] = (double)sum[slot];
    }
}

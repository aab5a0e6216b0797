/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_PAIRS_H
#define ORTHOSTAT_ACCURACY_LIGHT_PAIRS_H

#include "accuracy/light/light_data.h"

/* Eight tets under two displacements: what is kept of the tets, and which nodes and functions are theirs, is read once,
 * and registers of 512 bits compute both. */

enum { PAIR = 2 };

/* Registers that are put together of narrower ones take three times as long. (With sanitizers, so that they see it.) */
#if defined __AVX512F__ || defined __SANITIZE_ADDRESS__
enum { BY_PAIRS = 1 };
#else
enum { BY_PAIRS = 0 };
#endif

typedef float Sixteen __attribute__((vector_size(PAIR * WIDTH * sizeof(float))));
typedef double EightWide __attribute__((vector_size(WIDTH * sizeof(double))));

/* The same numbers for both. */
#define OST_FOR_BOTH(kept) \
    __builtin_shufflevector((Eight)(kept), (Eight)(kept), 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7)

/* Three numbers of eight rows each. */
static inline void transpose_pair(const Four row[PAIR * WIDTH], Sixteen out[3])
{
    Sixteen m[4];
    for (int k = 0; k < 4; k++) {
        const Eight first = __builtin_shufflevector(row[k], row[4 + k], 0, 1, 2, 3, 4, 5, 6, 7);
        const Eight second = __builtin_shufflevector(row[8 + k], row[12 + k], 0, 1, 2, 3, 4, 5, 6, 7);
        m[k] = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    }
    const Sixteen low01 = __builtin_shufflevector(m[0], m[1], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
    const Sixteen high01 =
        __builtin_shufflevector(m[0], m[1], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    const Sixteen low23 = __builtin_shufflevector(m[2], m[3], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
    const Sixteen high23 =
        __builtin_shufflevector(m[2], m[3], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    out[0] = __builtin_shufflevector(low01, low23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
    out[1] = __builtin_shufflevector(low01, low23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
    out[2] = __builtin_shufflevector(high01, high23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
}

/* The other way: of rows k, k + 4, k + 8 and k + 12, the fourth numbers being 0. */
static inline void mix_pair_back(const Sixteen in[3], Sixteen rows[4])
{
    const Sixteen none = {0.0F};
    const Sixteen low01 =
        __builtin_shufflevector(in[0], in[1], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
    const Sixteen high01 =
        __builtin_shufflevector(in[0], in[1], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    const Sixteen low23 =
        __builtin_shufflevector(in[2], none, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
    const Sixteen high23 =
        __builtin_shufflevector(in[2], none, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    rows[0] = __builtin_shufflevector(low01, low23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
    rows[1] = __builtin_shufflevector(low01, low23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
    rows[2] = __builtin_shufflevector(high01, high23, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
    rows[3] = __builtin_shufflevector(high01, high23, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
}

static inline void transpose_pair_back(const Sixteen in[3], Four row[PAIR * WIDTH])
{
    Sixteen m[4];
    mix_pair_back(in, m);
    for (int k = 0; k < 4; k++) {
        row[k] = __builtin_shufflevector(m[k], m[k], 0, 1, 2, 3);
        row[4 + k] = __builtin_shufflevector(m[k], m[k], 4, 5, 6, 7);
        row[8 + k] = __builtin_shufflevector(m[k], m[k], 8, 9, 10, 11);
        row[12 + k] = __builtin_shufflevector(m[k], m[k], 12, 13, 14, 15);
    }
}

/* In double precision. (GCC 12 converts four numbers in two halves, and eight at once.) */
static inline void transpose_pair_wide(const Sixteen in[3], Wide row[PAIR * WIDTH])
{
    Sixteen m[4];
    mix_pair_back(in, m);
    for (int k = 0; k < 4; k++) {
        const EightWide first = __builtin_convertvector(__builtin_shufflevector(m[k], m[k], 0, 1, 2, 3, 4, 5, 6, 7),
                                                        EightWide),
                        second = __builtin_convertvector(
                            __builtin_shufflevector(m[k], m[k], 8, 9, 10, 11, 12, 13, 14, 15), EightWide);
        row[k] = __builtin_shufflevector(first, first, 0, 1, 2, 3);
        row[4 + k] = __builtin_shufflevector(first, first, 4, 5, 6, 7);
        row[8 + k] = __builtin_shufflevector(second, second, 0, 1, 2, 3);
        row[12 + k] = __builtin_shufflevector(second, second, 4, 5, 6, 7);
    }
}

/* Of two displacements: padded, and their functions' values; and the forces that are added to, or the energies. */
typedef struct Pair {
    const double *u[PAIR];
    const float *w[PAIR];
    double *force[PAIR];
    float *of_functions[PAIR];
    double *energy[PAIR]; /* as ost_light_tets_energy */
    int at_rest;          /* are both displacements 0? */
} Pair;

/* Where the numbers of eight tets' nodes and functions start, in bytes: found once for reading and adding. */
enum { MOST_PLACES = 10 };
typedef struct Places {
    size_t node[WIDTH][MOST_PLACES], function[WIDTH][MOST_PLACES];
} Places;

static inline void find_pair_places(const OstLightTets *tets, const Eights *eights, int nodes, int functions,
                                    Places *places)
{
    for (int slot = 0; slot < WIDTH; slot++) {
        const OstLocal *node = ost_mesh_nodes_of(tets->mesh, eights->tet[slot]);
        for (int a = 0; a < nodes; a++)
            places->node[slot][a] = sizeof(Wide) * (size_t)node[a];
        for (int k = 0; k < functions; k++)
            places->function[slot][k] = sizeof(Four) * (size_t)function_of(tets, eights, slot, k);
    }
}

static inline Wide *wide_at(const double *first, size_t bytes)
{
    return (Wide *)(uintptr_t)((const char *)first + bytes);
}

static inline Four *four_at(const float *first, size_t bytes)
{
    return (Four *)(uintptr_t)((const char *)first + bytes);
}

/* How a node of each of eight tets moves from vertex 0. */
static inline void read_node_pair(const Places *places, const Pair *pair, int node, Sixteen moved[3])
{
    Four row[PAIR * WIDTH];
    for (int k = 0; k < PAIR; k++)
        for (int slot = 0; slot < WIDTH; slot++)
            row[WIDTH * k + slot] = __builtin_convertvector(
                *wide_at(pair->u[k], places->node[slot][node]) - *wide_at(pair->u[k], places->node[slot][0]), Four);
    transpose_pair(row, moved);
}

static inline void read_function_pair(const Places *places, const Pair *pair, int function, Sixteen w[3])
{
    Four row[PAIR * WIDTH];
    for (int k = 0; k < PAIR; k++)
        for (int slot = 0; slot < WIDTH; slot++)
            row[WIDTH * k + slot] = *four_at(pair->w[k], places->function[slot][function]);
    transpose_pair(row, w);
}

static inline void add_function_pair(const Places *places, const Pair *pair, int function, const Sixteen at_function[3])
{
    Four row[PAIR * WIDTH];
    transpose_pair_back(at_function, row);
    for (int k = 0; k < PAIR; k++) {
        float *const forces = pair->of_functions[k];
        for (int slot = 0; slot < WIDTH; slot++)
            *four_at(forces, places->function[slot][function]) += row[WIDTH * k + slot];
    }
}

/* Those on vertex 0 balance the others. */
static inline void add_nodes_pair(const Places *places, const Pair *pair, int nodes, Sixteen (*at_nodes)[3])
{
    Wide row[MOST_PLACES][PAIR * WIDTH];
    for (int a = 1; a < nodes; a++)
        transpose_pair_wide(at_nodes[a], row[a]);
    for (int k = 0; k < PAIR; k++) {
        double *const force = pair->force[k];
        for (int slot = 0; slot < WIDTH; slot++) {
            Wide sum = {0.0};
            for (int a = 1; a < nodes; a++) {
                *wide_at(force, places->node[slot][a]) += row[a][WIDTH * k + slot];
                sum += row[a][WIDTH * k + slot];
            }
            *wide_at(force, places->node[slot][0]) -= sum;
        }
    }
}

/* Work done at `count` places: moved by so much, under these forces. */
static inline void add_work(int count, Sixteen (*moved)[3], Sixteen (*forces)[3], Sixteen *work)
{
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 3; i++)
            *work += moved[k][i] * forces[k][i];
}

static inline void keep_energies(const OstLightTets *tets, const Eights *eights, const Sixteen *work, const Pair *pair)
{
    for (int slot = 0; slot < WIDTH; slot++)
        for (int k = 0; k < PAIR && eights->volume[slot] != 0.0F && eights->tet[slot] < tets->mesh->owned_tets; k++)
            pair->energy[k][eights->tet[slot]] = (double)(*work)[WIDTH * k + slot];
}

/* Local. Adds the forces to those of the pair. */
void ost_linear_pairs_apply(const OstLightTets *tets, const Pair *pair);
void ost_quadratic_pairs_apply(const OstLightTets *tets, const Pair *pair);

/* Local. Finds its energies. */
void ost_linear_pairs_energy(const OstLightTets *tets, const Pair *pair);
void ost_quadratic_pairs_energy(const OstLightTets *tets, const Pair *pair);

#endif

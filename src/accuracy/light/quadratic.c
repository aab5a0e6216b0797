/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/quadratic.h"

#include "core/kernel.h"
#include "element/quadrature.h"
#include "element/strain_batch.h"

typedef Eight Number;
typedef float Scalar;
#include "accuracy/light/straight_kernel.h"

enum { NODES = 10, FUNCTIONS = 10 };

typedef int32_t Bits __attribute__((vector_size(WIDTH * sizeof(int32_t))));

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

/* The sign bits of edges' functions that tets take the other way (complement->turned). */
static inline void find_turns(const OstLightTets *tets, const Eights *eights, Bits turns[EDGES])
{
    Bits turned;
    for (int slot = 0; slot < WIDTH; slot++)
        turned[slot] = tets->complement->turned[eights->tet[slot]];
    for (int e = 0; e < EDGES; e++)
        turns[e] = (turned << (31 - e)) & INT32_MIN;
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

/* --- forces of eight tets --- */

static inline void open_straight(const Eights *eights, const Kept *bend, Straight *tet)
{
    tet->volume = eights->volume;
    memcpy(tet->gradient[1], eights->gradient, sizeof eights->gradient);
    for (int i = 0; i < 3; i++)
        tet->gradient[0][i] = -(tet->gradient[1][i] + tet->gradient[2][i] + tet->gradient[3][i]);
    memcpy(tet->bend, bend, sizeof tet->bend);
}

/* stress = C strain */
static inline void find_stress(const Kept *c, const Eight strain[6], Eight stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = c[ost_upper[p][0]] * strain[0];
        for (int q = 1; q < 6; q++)
            stress[p] += c[ost_upper[p][q]] * strain[q];
    }
}

/* As ost_stretch_stress (element/strain_batch.h). */
static inline void find_stretch_stress(const Eight a[6], float shear, const Eight strain[6], Eight stress[6])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    Eight half[9], bulk = {0.0F};
    for (int p = 0; p < 6; p++)
        bulk += a[p] * strain[p];
    bulk *= 1.0F - 2.0F * shear;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            half[3 * i + j] = 2.0F * a[place[i][j]] * strain[place[j][j]];
            for (int k = 0; k < 3; k++) /* engineering shear */
                if (k != j)
                    half[3 * i + j] += a[place[i][k]] * strain[place[k][j]];
            half[3 * i + j] *= shear;
        }
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
        stress[p] = bulk * a[p] + half[3 * i] * a[place[0][j]] + half[3 * i + 1] * a[place[1][j]] +
                    half[3 * i + 2] * a[place[2][j]];
    }
}

static inline void integrate(const Straight *tet, const Kept *c, Eight strain[PRODUCTS][6], Eight moment[PRODUCTS][6])
{
    Eight stress[PRODUCTS][6];
    for (int k = 0; k < PRODUCTS; k++)
        find_stress(c, strain[k], stress[k]);
    integrate_stress(tet, stress, moment);
}

/* With axes about a line: by quadrature. */
static inline void integrate_points(const Straight *tet, const AboutLine *line, const Kept *offset,
                                    Eight strain[PRODUCTS][6], Eight moment[PRODUCTS][6])
{
    memset(moment, 0, PRODUCTS * sizeof *moment);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        const Eight weight = (float)point->weight * tet->volume;
        Eight here[6], stress[6], tensor[6];
        float product[PRODUCTS];
        find_products(point->at, product);
        find_strain_at(product, strain, here);
        find_stretch_at(line, offset, point->at, tensor);
        find_stretch_stress(tensor, line->shear, here, stress);
        add_moments(product, &weight, stress, moment);
    }
}

static inline void find_eight(const OstLightTets *tets, size_t k, const float *functions, const Bits turns[EDGES],
                              Eight moved[NODES][3], Eight w[FUNCTIONS][3], Eight at_nodes[NODES][3],
                              Eight at_functions[FUNCTIONS][3])
{
    const Eights *eights = &tets->eights[k];
    const Kept *elastic = tets->elastic + numbers_kept[tets->keeping] * k;
    Eight strain[PRODUCTS][6], moment[PRODUCTS][6];
    Straight tet;
    open_straight(eights, tets->bend + BENDS * k, &tet);
    read_nodes(tets, eights, moved);
    read_functions(tets, eights, functions, turns, w);
    memset(strain, 0, sizeof strain);
    add_own_strain(&tet, moved[0], strain);
    add_surplus_strain(&tet, w[0], strain);
    if (tets->keeping == KEEP_OFFSETS)
        integrate_points(&tet, &tets->line, elastic, strain, moment);
    else
        integrate(&tet, elastic, strain, moment);
    find_own_forces(&tet, moment, at_nodes[0]);
    find_surplus_forces(&tet, moment, at_functions[0]);
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

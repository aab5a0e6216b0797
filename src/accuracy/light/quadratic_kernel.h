/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_QUADRATIC_KERNEL_H
#define ORTHOSTAT_ACCURACY_LIGHT_QUADRATIC_KERNEL_H

#include "accuracy/light/light_data.h"
#include "element/quadrature.h"
#include "element/strain_batch.h"

/* The arithmetic of quadratic tets, for the file that includes this: it defines Number and FROM as for
 * linear_kernel.h. */

typedef float Scalar;
#include "accuracy/light/straight_kernel.h"

enum { NODES = 10, FUNCTIONS = 10 };

typedef int32_t Bits __attribute__((vector_size(WIDTH * sizeof(int32_t))));

/* The sign bits of edges' functions that tets take the other way (complement->turned). */
static inline void find_turns(const OstLightTets *tets, const Eights *eights, Bits turns[EDGES])
{
    Bits turned;
    for (int slot = 0; slot < WIDTH; slot++)
        turned[slot] = tets->complement->turned[eights->tet[slot]];
    for (int e = 0; e < EDGES; e++)
        turns[e] = (turned << (31 - e)) & INT32_MIN;
}

static inline void open_straight(const Eights *eights, const Kept *bend, Straight *tet)
{
    tet->volume = FROM(eights->volume);
    for (int i = 0; i < 3; i++) {
        for (int v = 1; v < VERTICES; v++)
            tet->gradient[v][i] = FROM(eights->gradient[v - 1][i]);
        tet->gradient[0][i] = -(tet->gradient[1][i] + tet->gradient[2][i] + tet->gradient[3][i]);
    }
    for (int n = 0; n < BENDS; n++)
        tet->bend[n / 3][n % 3] = FROM(bend[n]);
}

/* stress = C strain */
static inline void find_stress(const Kept *c, const Number strain[6], Number stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = FROM(c[ost_upper[p][0]]) * strain[0];
        for (int q = 1; q < 6; q++)
            stress[p] += FROM(c[ost_upper[p][q]]) * strain[q];
    }
}

/* As ost_stretch_stress (element/strain_batch.h). */
static inline void find_stretch_stress(const Eight tensor[6], float shear, const Number strain[6], Number stress[6])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    Number a[6], half[9], bulk = {0.0F};
    for (int p = 0; p < 6; p++) {
        a[p] = FROM(tensor[p]);
        bulk += a[p] * strain[p];
    }
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

static inline void integrate(const Straight *tet, const Kept *c, Number strain[PRODUCTS][6], Number moment[PRODUCTS][6])
{
    Number stress[PRODUCTS][6];
    for (int k = 0; k < PRODUCTS; k++)
        find_stress(c, strain[k], stress[k]);
    integrate_stress(tet, stress, moment);
}

/* With axes about a line: by quadrature. */
static inline void integrate_points(const Straight *tet, const AboutLine *line, const Kept *offset,
                                    Number strain[PRODUCTS][6], Number moment[PRODUCTS][6])
{
    Number sum[SUMS][6], of_stress[SUMS][6];
    add_up(strain, sum);
    memset(of_stress, 0, sizeof of_stress);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        const Number weight = (float)point->weight * tet->volume;
        const Mix mix = find_mix(q);
        Number here[6], stress[6];
        Eight tensor[6];
        find_strain_at(&mix, sum, here);
        find_stretch_at(line, offset, point->at, tensor);
        find_stretch_stress(tensor, line->shear, here, stress);
        add_moments(&mix, &weight, stress, of_stress);
    }
    hand_out_sums(6, of_stress[0], moment[0]);
}

/* Forces of what nodes and functions have moved. */
static inline void find_forces(const OstLightTets *tets, size_t k, Number (*moved)[3], Number (*w)[3],
                               Number (*at_nodes)[3], Number (*at_functions)[3])
{
    const Kept *elastic = tets->elastic + numbers_kept[tets->keeping] * k;
    Number strain[PRODUCTS][6], moment[PRODUCTS][6];
    Straight tet;
    open_straight(&tets->eights[k], tets->bend + BENDS * k, &tet);
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

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/polar.h"

#include "element/eigen_batch.h"
#include "element/strain_batch.h"

/* Below this length, relative to the longest, a deformed principal direction is rounding error. */
static const double vanishing = 1e-14;

/* Green's strain, 1/2 (F'F - I), from the displacement gradient. Its eigenvectors are U's. */
static void green_strain(const OstSimd slope[9], OstSimd strain[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            strain[3 * i + j] = 0.5 * (slope[3 * i + j] + slope[3 * j + i] + slope[i] * slope[j] +
                                       slope[3 + i] * slope[3 + j] + slope[6 + i] * slope[6 + j]);
}

/* Puts the larger eigenvalue first; where two eigenvectors change places, one turns round, so that they stay
 * right-handed. */
static void order(OstSimd *first, OstSimd *second, OstSimd *of_first, OstSimd *of_second)
{
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const int swap = (*first)[slot] < (*second)[slot];
        const double larger = swap ? (*second)[slot] : (*first)[slot];
        (*second)[slot] = swap ? (*first)[slot] : (*second)[slot];
        (*first)[slot] = larger;
        for (int i = 0; i < 3; i++) {
            const double kept = of_first[i][slot];
            of_first[i][slot] = swap ? of_second[i][slot] : kept;
            of_second[i][slot] = swap ? -kept : of_second[i][slot];
        }
    }
}

static void principal_directions(const OstSimd slope[9], OstSimd before[9])
{
    OstSimd strain[9];
    green_strain(slope, strain);
    ost_simd_jacobi(3, strain, before);
    order(&strain[0], &strain[4], before, before + 3);
    order(&strain[4], &strain[8], before + 3, before + 6);
    order(&strain[0], &strain[4], before, before + 3);
}

/* Any unit vector at right angles to a. */
static void choose_perpendicular(const OstSimd a[3], int slot, OstSimd chosen[3])
{
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(a[i][slot]) < fabs(a[least][slot]))
            least = i;
    const double along = a[least][slot];
    const double length = sqrt(1.0 - along * along);
    for (int i = 0; i < 3; i++)
        chosen[i][slot] = ((i == least ? 1.0 : 0.0) - along * a[i][slot]) / length;
}

static inline void length_of(const OstSimd a[3], OstSimd *length)
{
    *length = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        (*length)[slot] = sqrt((*length)[slot]);
}

/* a -= (a·unit) unit */
static inline void make_perpendicular(const OstSimd unit[3], OstSimd a[3])
{
    const OstSimd along = unit[0] * a[0] + unit[1] * a[1] + unit[2] * a[2];
    for (int i = 0; i < 3; i++)
        a[i] -= along * unit[i];
}

/* The deformed directions F v, made orthonormal. Where F flattens the tet to a line or a point, any that fit serve. */
static void orthonormalise(const OstSimd before[9], OstSimd deformed[9], OstSimd after[9])
{
    OstSimd first, second, again;
    length_of(deformed, &first);
    for (int i = 0; i < 3; i++)
        after[i] = deformed[i] / first;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        for (int i = 0; i < 3 && !(first[slot] > vanishing); i++)
            after[i][slot] = before[i][slot];
    make_perpendicular(after, deformed + 3);
    length_of(deformed + 3, &second);
    for (int i = 0; i < 3; i++)
        after[3 + i] = deformed[3 + i] / second;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        if (!(second[slot] > vanishing * first[slot]) || !(first[slot] > vanishing))
            choose_perpendicular(after, slot, after + 3);
    make_perpendicular(after, after + 3); /* once more, since the first time much may have cancelled */
    length_of(after + 3, &again);
    for (int i = 3; i < 6; i++)
        after[i] /= again;
    ost_simd_cross(after, after + 3, after + 6);
}

/* stretch - 1 = a'F v - 1 = a'(grad u) v - |a - v|^2 / 2 */
void ost_polar(const OstSimd slope[9], OstPolar *polar)
{
    OstSimd deformed[9];
    OstSimd moved[9]; /* (grad u) v */
    OstSimd *v = polar->before;
    OstSimd *a = polar->after;
    principal_directions(slope, v);
    for (int k = 0; k < 9; k += 3)
        for (int i = 0; i < 3; i++) {
            moved[k + i] = slope[3 * i] * v[k] + slope[3 * i + 1] * v[k + 1] + slope[3 * i + 2] * v[k + 2];
            deformed[k + i] = v[k + i] + moved[k + i];
        }
    orthonormalise(v, deformed, a);
    for (int k = 0; k < 3; k++) {
        polar->strain[k] = (OstSimd){0};
        for (int i = 3 * k; i < 3 * k + 3; i++)
            polar->strain[k] += a[i] * moved[i] - 0.5 * (a[i] - v[i]) * (a[i] - v[i]);
        polar->stretch[k] = 1.0 + polar->strain[k];
    }
}

void ost_polar_rotation(const OstPolar *polar, OstSimd rotation[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            rotation[3 * i + j] = polar->after[i] * polar->before[j] + polar->after[3 + i] * polar->before[3 + j] +
                                  polar->after[6 + i] * polar->before[6 + j];
}

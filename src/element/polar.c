/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/polar.h"

#include "element/strain_batch.h"

/* Below this length, relative to the longest, a deformed principal direction is rounding error. */
static const double vanishing = 1e-14;

static inline void length_of(const OstSimd a[3], OstSimd *length)
{
    *length = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    ost_simd_square_root(length);
}

/* Green's strain, 1/2 (F'F - I), from the displacement gradient: 11 22 33 12 23 31. Its eigenvectors are U's. */
static inline void green_strain(const OstSimd slope[9], OstSimd strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        strain[i] =
            slope[4 * i] + 0.5 * (slope[i] * slope[i] + slope[3 + i] * slope[3 + i] + slope[6 + i] * slope[6 + i]);
        strain[3 + i] = 0.5 * (slope[3 * i + j] + slope[3 * j + i] + slope[i] * slope[j] + slope[3 + i] * slope[3 + j] +
                               slope[6 + i] * slope[6 + j]);
    }
}

/* Of a traceless matrix scaled so that the sum of its squares is 6: the eigenvalue farthest from the others, which is
 * the largest where the determinant is positive, otherwise the smallest. Its size is 2 cos(phi), phi up to 30 degrees,
 * with 2 cos(3 phi) = |determinant|. */
static inline void find_single_eigenvalue(const OstSimd *determinant, OstSimd *eigenvalue)
{
    const OstSimdMask negative = *determinant < 0.0;
    const OstSimd target = 0.5 * OST_SIMD_SELECT(negative, -*determinant, *determinant);
    OstSimd cosine = 0.866025 + target * (0.166667 - 0.032692 * target); /* right to 0.002; each step squares that */
    for (int step = 0; step < 3; step++) {
        const OstSimd square = cosine * cosine;
        cosine = (8.0 * square * cosine + target) / (12.0 * square - 3.0);
    }
    *eigenvalue = OST_SIMD_SELECT(negative, -2.0 * cosine, 2.0 * cosine);
}

/* The column of the adjugate of b - eigenvalue I with the largest diagonal: the eigenvector. Of b = 0, any. */
static inline void find_eigenvector(const OstSimd b[6], const OstSimd *eigenvalue, OstSimd vector[3])
{
    const OstSimd d[3] = {b[0] - *eigenvalue, b[1] - *eigenvalue, b[2] - *eigenvalue};
    const OstSimd adjugate[6] = {d[1] * d[2] - b[4] * b[4], d[2] * d[0] - b[5] * b[5], d[0] * d[1] - b[3] * b[3],
                                 b[4] * b[5] - b[3] * d[2], b[5] * b[3] - b[4] * d[0], b[3] * b[4] - b[5] * d[1]};
    const OstSimdMask second = adjugate[1] > adjugate[0];
    const OstSimdMask third = (adjugate[2] > adjugate[0]) & (adjugate[2] > adjugate[1]);
    OstSimd length;
    vector[0] = OST_SIMD_SELECT(third, adjugate[5], OST_SIMD_SELECT(second, adjugate[3], adjugate[0]));
    vector[1] = OST_SIMD_SELECT(third, adjugate[4], OST_SIMD_SELECT(second, adjugate[1], adjugate[3]));
    vector[2] = OST_SIMD_SELECT(third, adjugate[2], OST_SIMD_SELECT(second, adjugate[4], adjugate[5]));
    length_of(vector, &length);
    for (int i = 0; i < 3; i++)
        vector[i] /= length;
}

/* Two unit vectors that make a right-handed system with a third, which comes last (T. Duff and others, Building an
 * orthonormal basis, revisited, 2017). */
static inline void find_perpendiculars(const OstSimd third[3], OstSimd first[3], OstSimd second[3])
{
    const OstSimdMask down = third[2] < 0.0;
    const OstSimd sign = OST_SIMD_SELECT(down, (OstSimd){0} - 1.0, (OstSimd){0} + 1.0);
    const OstSimd a = -1.0 / (sign + third[2]);
    const OstSimd b = third[0] * third[1] * a;
    first[0] = 1.0 + sign * third[0] * third[0] * a;
    first[1] = sign * b;
    first[2] = -sign * third[0];
    second[0] = b;
    second[1] = sign + third[1] * third[1] * a;
    second[2] = -third[1];
}

/* x'Ay */
static inline void form(const OstSimd a[6], const OstSimd x[3], const OstSimd y[3], OstSimd *product)
{
    *product = x[0] * (a[0] * y[0] + a[3] * y[1] + a[5] * y[2]) + x[1] * (a[3] * y[0] + a[1] * y[1] + a[4] * y[2]) +
               x[2] * (a[5] * y[0] + a[4] * y[1] + a[2] * y[2]);
}

/* Of two directions at right angles, those in their plane that are principal: the larger eigenvalue first. The one
 * rotation of Jacobi's, by the angle whose double has the tangent 2 xy / (xx - yy). */
static inline void make_principal(const OstSimd a[6], OstSimd x[3], OstSimd y[3])
{
    OstSimd xx, xy, yy;
    form(a, x, x, &xx);
    form(a, x, y, &xy);
    form(a, y, y, &yy);
    const OstSimd half = 0.5 * (xx - yy);
    const OstSimdMask swap = half < 0.0;
    const OstSimd width = OST_SIMD_SELECT(swap, -half, half) + 1e-150; /* not 0 where nothing is to be turned */
    OstSimd length = width * width + xy * xy;
    ost_simd_square_root(&length);
    OstSimd large = 0.5 + 0.5 * width / length;
    ost_simd_square_root(&large);
    const OstSimd small = 0.5 * xy / (length * large);
    const OstSimd cosine = OST_SIMD_SELECT(swap, small, large);
    const OstSimd sine = OST_SIMD_SELECT(swap, large, small);
    for (int i = 0; i < 3; i++) {
        const OstSimd kept = x[i];
        x[i] = cosine * kept + sine * y[i];
        y[i] = cosine * y[i] - sine * kept;
    }
}

/* Without iterations to convergence, since every tet of a batch would wait for the slowest: the single eigenvalue of
 * the deviator from its determinant, and the others in the plane that is left, where they may be equal. */
static inline void principal_directions(const OstSimd slope[9], OstSimd before[9])
{
    OstSimd b[6], single[3], first[3], second[3], eigenvalue;
    green_strain(slope, b);
    const OstSimd mean = (b[0] + b[1] + b[2]) / 3.0;
    for (int i = 0; i < 3; i++)
        b[i] -= mean;
    OstSimd size = (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]) / 6.0 + (b[3] * b[3] + b[4] * b[4] + b[5] * b[5]) / 3.0;
    ost_simd_square_root(&size);
    const OstSimd inverse = 1.0 / (size + 1e-300);
    for (int n = 0; n < 6; n++)
        b[n] *= inverse;
    const OstSimd determinant =
        b[0] * (b[1] * b[2] - b[4] * b[4]) - b[3] * (b[3] * b[2] - b[4] * b[5]) + b[5] * (b[3] * b[4] - b[1] * b[5]);
    const OstSimdMask last = determinant < 0.0;
    find_single_eigenvalue(&determinant, &eigenvalue);
    find_eigenvector(b, &eigenvalue, single);
    find_perpendiculars(single, first, second);
    make_principal(b, first, second);
    for (int i = 0; i < 3; i++) {
        before[i] = OST_SIMD_SELECT(last, first[i], single[i]);
        before[3 + i] = OST_SIMD_SELECT(last, second[i], first[i]);
        before[6 + i] = OST_SIMD_SELECT(last, single[i], second[i]);
    }
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

/* a -= (a·unit) unit */
static inline void make_perpendicular(const OstSimd unit[3], OstSimd a[3])
{
    const OstSimd along = unit[0] * a[0] + unit[1] * a[1] + unit[2] * a[2];
    for (int i = 0; i < 3; i++)
        a[i] -= along * unit[i];
}

/* The deformed directions F v, made orthonormal. Where F flattens the tet to a line or a point, any that fit serve. */
static inline void orthonormalise(const OstSimd before[9], OstSimd deformed[9], OstSimd after[9])
{
    OstSimd first, second, again;
    length_of(deformed, &first);
    const OstSimdMask point = first <= vanishing;
    for (int i = 0; i < 3; i++)
        after[i] = OST_SIMD_SELECT(point, before[i], deformed[i] / first);
    make_perpendicular(after, deformed + 3);
    length_of(deformed + 3, &second);
    for (int i = 0; i < 3; i++)
        after[3 + i] = deformed[3 + i] / second;
    const OstSimdMask line = point | (second <= vanishing * first);
    for (int slot = 0; slot < OST_SIMD_WIDTH && ost_simd_any(&line); slot++)
        if (line[slot])
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

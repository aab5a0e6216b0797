/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_EIGEN_BATCH_H
#define ORTHOSTAT_ELEMENT_EIGEN_BATCH_H

#include "element/simd.h"

#include <math.h>
#include <string.h>

/* Eigenvalues and eigenvectors of small symmetric matrices, one of each tet of a batch, by Jacobi's rotations. */

enum { OST_JACOBI_SWEEPS = 15 }; /* convergence is quadratic: five or six suffice */

/* Is every matrix diagonal up to rounding? */
static inline int ost_simd_is_diagonal(int n, const OstSimd *a)
{
    OstSimd off = {0};
    OstSimd diagonal = {0};
    for (int p = 0; p < n; p++) {
        diagonal += a[n * p + p] * a[n * p + p];
        for (int q = p + 1; q < n; q++)
            off += a[n * p + q] * a[n * p + q];
    }
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        if (!(off[slot] <= 1e-32 * diagonal[slot]))
            return 0;
    return 1;
}

/* rows p and q of b: turned by the angle with this cosine and sine */
static inline void ost_simd_turn(const OstSimd *cosine, const OstSimd *sine, OstSimd *p, OstSimd *q)
{
    const OstSimd kept = *p;
    *p = *cosine * kept - *sine * *q;
    *q = *sine * kept + *cosine * *q;
}

/* Cosine and sine of the rotation that makes a_pq zero. */
static inline void ost_jacobi_angle(const OstSimd *pp, const OstSimd *pq, const OstSimd *qq, OstSimd *cosine,
                                    OstSimd *sine)
{
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const double twice = 2.0 * (*pq)[slot];
        const double gap = (*qq)[slot] - (*pp)[slot];
        const double length = sqrt(gap * gap + twice * twice) + 1e-150; /* not 0 where nothing is to be turned */
        const double tangent = twice / (gap + copysign(length, gap));
        (*cosine)[slot] = 1.0 / sqrt(1.0 + tangent * tangent);
        (*sine)[slot] = tangent * (*cosine)[slot];
    }
}

/* a (n × n, full) becomes diagonal; the rows of v (n × n) are the eigenvectors, a right-handed system. */
static inline void ost_simd_jacobi(int n, OstSimd *a, OstSimd *v)
{
    memset(v, 0, (size_t)(n * n) * sizeof *v);
    for (int p = 0; p < n; p++)
        v[n * p + p] += 1.0;
    for (int sweep = 0; sweep < OST_JACOBI_SWEEPS && !ost_simd_is_diagonal(n, a); sweep++)
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                OstSimd cosine;
                OstSimd sine;
                ost_jacobi_angle(&a[n * p + p], &a[n * p + q], &a[n * q + q], &cosine, &sine);
                for (int i = 0; i < n; i++)
                    ost_simd_turn(&cosine, &sine, &a[n * p + i], &a[n * q + i]);
                for (int i = 0; i < n; i++)
                    ost_simd_turn(&cosine, &sine, &a[n * i + p], &a[n * i + q]);
                for (int i = 0; i < n; i++)
                    ost_simd_turn(&cosine, &sine, &v[n * p + i], &v[n * q + i]);
            }
}

#endif

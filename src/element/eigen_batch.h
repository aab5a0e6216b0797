/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_EIGEN_BATCH_H
#define ORTHOSTAT_ELEMENT_EIGEN_BATCH_H

#include "element/simd.h"

#include <string.h>

/* Eigenvalues and eigenvectors of small symmetric matrices, one of each tet of a batch, by Jacobi's rotations. */

enum { OST_JACOBI_SWEEPS = 15 }; /* convergence is quadratic: five or six suffice */

/* A rotation of rows p and q. */
typedef struct OstJacobi {
    OstSimd cosine, sine, tangent;
} OstJacobi;

static inline void ost_jacobi_turn(const OstJacobi *by, OstSimd *p, OstSimd *q)
{
    const OstSimd kept = *p;
    *p = by->cosine * kept - by->sine * *q;
    *q = by->sine * kept + by->cosine * *q;
}

/* Makes pq zero: by the smaller of the two angles whose tangent t has t^2 pq + t (qq - pp) = pq. */
static inline void ost_jacobi_diagonalise(OstSimd *pp, OstSimd *pq, OstSimd *qq, OstJacobi *by)
{
    const OstSimd gap = *qq - *pp;
    const OstSimd width = OST_SIMD_SELECT(gap < 0.0, -gap, gap) + 1e-150; /* not 0 where nothing is to be turned */
    const OstSimd twice = 2.0 * OST_SIMD_SELECT(gap < 0.0, -*pq, *pq);
    OstSimd length = width * width + twice * twice;
    ost_simd_square_root(&length);
    by->cosine = 0.5 + 0.5 * width / length;
    ost_simd_square_root(&by->cosine);
    by->tangent = twice / (width + length);
    by->sine = by->tangent * by->cosine;
    *pp -= by->tangent * *pq;
    *qq += by->tangent * *pq;
    *pq = (OstSimd){0};
}

/* Are the sums of squares off the diagonals nothing, beside those on them? */
static inline int ost_jacobi_is_done(const OstSimd *off, const OstSimd *diagonal)
{
    const OstSimdMask more = *off > 1e-32 * *diagonal;
    return !ost_simd_any(&more);
}

/* 3 × 3: a (11 22 33 12 23 31) becomes diagonal; the rows of v are the eigenvectors, a right-handed system. */
static inline void ost_simd_eigen3(OstSimd a[6], OstSimd v[9])
{
    memset(v, 0, 9 * sizeof *v);
    for (int p = 0; p < 3; p++)
        v[4 * p] += 1.0;
    for (int sweep = 0; sweep < OST_JACOBI_SWEEPS; sweep++) {
        const OstSimd off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
        const OstSimd diagonal = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
        if (ost_jacobi_is_done(&off, &diagonal))
            return;
        for (int p = 0; p < 3; p++) {
            const int q = (p + 1) % 3, r = (p + 2) % 3;
            OstJacobi by;
            ost_jacobi_diagonalise(&a[p], &a[3 + p], &a[q], &by);
            ost_jacobi_turn(&by, &a[3 + r], &a[3 + q]);
            for (int i = 0; i < 3; i++)
                ost_jacobi_turn(&by, &v[3 * p + i], &v[3 * q + i]);
        }
    }
}

/* The upper triangle of a (n × n) becomes diagonal; the rows of v (n × n) are the eigenvectors. */
static inline void ost_simd_eigen(int n, OstSimd *a, OstSimd *v)
{
    memset(v, 0, (size_t)(n * n) * sizeof *v);
    for (int p = 0; p < n; p++)
        v[n * p + p] += 1.0;
    for (int sweep = 0; sweep < OST_JACOBI_SWEEPS; sweep++) {
        OstSimd off = {0}, diagonal = {0};
        for (int p = 0; p < n; p++) {
            diagonal += a[n * p + p] * a[n * p + p];
            for (int q = p + 1; q < n; q++)
                off += a[n * p + q] * a[n * p + q];
        }
        if (ost_jacobi_is_done(&off, &diagonal))
            return;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                OstJacobi by;
                ost_jacobi_diagonalise(&a[n * p + p], &a[n * p + q], &a[n * q + q], &by);
                for (int i = 0; i < p; i++)
                    ost_jacobi_turn(&by, &a[n * i + p], &a[n * i + q]);
                for (int i = p + 1; i < q; i++)
                    ost_jacobi_turn(&by, &a[n * p + i], &a[n * i + q]);
                for (int i = q + 1; i < n; i++)
                    ost_jacobi_turn(&by, &a[n * p + i], &a[n * q + i]);
                for (int i = 0; i < n; i++)
                    ost_jacobi_turn(&by, &v[n * p + i], &v[n * q + i]);
            }
    }
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_EIGEN_BATCH_H
#define ORTHOSTAT_ELEMENT_EIGEN_BATCH_H

#include "element/simd.h"

#include <string.h>

/* Eigenvalues and eigenvectors of small symmetric matrices, one of each tet of a batch. */

enum { OST_LARGEST_EIGEN = 9, OST_MOST_STEPS = 30 }; /* two or three steps suffice */

/* a = h a h and v = h v, with h = I - factor u u', u of the last m rows, a of the last m rows and columns. */
static inline void ost_simd_reflect(int n, int m, const OstSimd *u, const OstSimd *factor, OstSimd *a, OstSimd *v)
{
    OstSimd w[OST_LARGEST_EIGEN], share = {0};
    a += (n + 1) * (n - m);
    v += n * (n - m);
    for (int i = 0; i < m; i++) {
        w[i] = a[n * i] * u[0];
        for (int j = 1; j < m; j++)
            w[i] += a[n * i + j] * u[j];
        w[i] *= *factor;
        share += 0.5 * *factor * w[i] * u[i];
    }
    for (int i = 0; i < m; i++)
        w[i] -= share * u[i];
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++)
            a[n * i + j] -= u[i] * w[j] + w[i] * u[j];
    for (int j = 0; j < n; j++) {
        OstSimd along = u[0] * v[j];
        for (int i = 1; i < m; i++)
            along += u[i] * v[n * i + j];
        along *= *factor;
        for (int i = 0; i < m; i++)
            v[n * i + j] -= along * u[i];
    }
}

/* Householder's reflections make the full symmetric a (n × n) tridiagonal: d on and e beside the diagonal, a = v'tv. */
static inline void ost_simd_tridiagonal(int n, OstSimd *a, OstSimd *d, OstSimd *e, OstSimd *v)
{
    memset(v, 0, (size_t)(n * n) * sizeof *v);
    for (int p = 0; p < n; p++)
        v[n * p + p] += 1.0;
    for (int k = 0; k < n; k++) {
        const int m = n - k - 1;
        OstSimd *u = a + n * k + k + 1; /* the row right of the diagonal becomes the normal of the mirror */
        OstSimd size = {0};
        d[k] = a[n * k + k];
        e[k] = m > 0 ? u[0] : (OstSimd){0};
        if (m < 2)
            continue;
        for (int i = 0; i < m; i++)
            size += u[i] * u[i];
        OstSimd length = size;
        ost_simd_square_root(&length);
        e[k] = OST_SIMD_SELECT(u[0] > 0.0, -length, length);
        const OstSimd factor = 1.0 / (size - u[0] * e[k] + 1e-300); /* 2 / u'u; u is 0 where there is nothing to do */
        u[0] -= e[k];
        ost_simd_reflect(n, m, u, &factor, a, v);
    }
}

/* One step of the QL method with Wilkinson's shift, on rows l to n - 1. */
static inline void ost_simd_ql(int n, int l, const OstSimd *least, OstSimd *d, OstSimd *e, OstSimd *v)
{
    const OstSimd half = 0.5 * (d[l + 1] - d[l]);
    OstSimd root = half * half + e[l] * e[l] + *least * *least;
    ost_simd_square_root(&root);
    const OstSimd shift = d[l] - e[l] * e[l] / (half + OST_SIMD_SELECT(half < 0.0, -root, root));
    OstSimd p = d[n - 1] - shift, cosine = {0}, sine = {0};
    cosine += 1.0;
    for (int i = n - 2; i >= l; i--) {
        p = OST_SIMD_SELECT((p < *least) & (p > -*least), *least, p); /* so that there is an angle */
        const OstSimd g = cosine * e[i], h = cosine * p, shifted = d[i] - shift;
        OstSimd length = p * p + e[i] * e[i];
        ost_simd_square_root(&length);
        e[i + 1] = sine * length;
        const OstSimd inverse = 1.0 / length;
        sine = e[i] * inverse;
        cosine = p * inverse;
        p = cosine * shifted - sine * g;
        d[i + 1] = h + sine * (cosine * g + sine * shifted) + shift;
        for (int j = 0; j < n; j++) {
            const OstSimd kept = v[n * (i + 1) + j];
            v[n * (i + 1) + j] = sine * v[n * i + j] + cosine * kept;
            v[n * i + j] = cosine * v[n * i + j] - sine * kept;
        }
    }
    e[l] = sine * p;
    d[l] = cosine * p + shift;
}

/* The symmetric a (n × n, full; overwritten): eigenvalues d; the rows of v (n × n) are the eigenvectors. (C. Reinsch
 * and others, tred2 and tql2, Numerische Mathematik 11, 1968. Every tet takes the steps that one of them wants.) */
static inline void ost_simd_eigen(int n, OstSimd *a, OstSimd *d, OstSimd *v)
{
    OstSimd e[OST_LARGEST_EIGEN], size = {0};
    for (int i = 0; i < n * n; i++)
        size += a[i] * a[i];
    ost_simd_square_root(&size);
    const OstSimd least = 1e-30 * size + 1e-150;
    ost_simd_tridiagonal(n, a, d, e, v);
    for (int l = 0; l < n - 1; l++)
        for (int step = 0; step < OST_MOST_STEPS; step++) {
            const OstSimdMask more = e[l] * e[l] > 1e-32 * size * size;
            if (!ost_simd_any(&more))
                break;
            ost_simd_ql(n, l, &least, d, e, v);
        }
}

#endif

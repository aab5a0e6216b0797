/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/biot.h"

#include "element/eigen_batch.h"
#include "element/strain_batch.h"

enum { STRAINS = 6, COUNT = 9 };

/* Eigenvalues below this, relative to the sum of all, count as negative. */
static const double rounding = 1e-13;

/* The components of a shear strain in ascending order, and the axis that is left. */
static const int pair[3][3] = {{0, 1, 2}, {1, 2, 0}, {0, 2, 1}};

/* Where component ij of a strain is. */
static const int strain_at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/* World strains of unit strains along the principal directions before the deformation: strain = w principal. */
static inline void principal_to_world(const OstPolar *polar, OstSimd w[STRAINS][STRAINS])
{
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++) {
            const int j = (i + 1) % 3;
            const int b = (a + 1) % 3;
            const OstSimd *va = polar->before + 3 * a;
            const OstSimd *vb = polar->before + 3 * b;
            w[i][a] = va[i] * va[i];
            w[3 + i][a] = 2.0 * va[i] * va[j];
            w[i][3 + a] = va[i] * vb[i];
            w[3 + i][3 + a] = va[i] * vb[j] + va[j] * vb[i];
        }
}

void ost_biot_strain(const OstPolar *polar, OstSimd strain[6])
{
    OstSimd w[STRAINS][STRAINS];
    principal_to_world(polar, w);
    for (int p = 0; p < STRAINS; p++)
        strain[p] = w[p][0] * polar->strain[0] + w[p][1] * polar->strain[1] + w[p][2] * polar->strain[2];
}

/* 1 / (sigma_i + sigma_j) of each pair */
static inline void inverse_sums(const OstPolar *polar, OstSimd inverse[3])
{
    for (int k = 0; k < 3; k++) {
        const OstSimd sum = polar->stretch[pair[k][0]] + polar->stretch[pair[k][1]];
        inverse[k] = 1.0 / OST_SIMD_SELECT(sum > OST_LEAST_STRETCH_SUM, sum, OST_LEAST_STRETCH_SUM + (OstSimd){0});
    }
}

/* share_ij = 2 sigma_i / (sigma_i + sigma_j): the shear strain 2 dU_ij is share_ij g_ij + share_ji g_ji, with g_ij =
 * a_i'dF v_j. */
static inline void shear_shares(const OstPolar *polar, const OstSimd inverse[3], OstSimd share[3][3])
{
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0];
        const int j = pair[k][1];
        share[k][k] = (OstSimd){0} + 1.0;
        share[i][j] = 2.0 * polar->stretch[i] * inverse[k];
        share[j][i] = 2.0 * polar->stretch[j] * inverse[k];
    }
}

void ost_biot_strain_change(const OstPolar *polar, const OstSimd df[9], OstSimd change[6])
{
    OstSimd w[STRAINS][STRAINS], inverse[3], share[3][3], g[3][3], principal[STRAINS];
    principal_to_world(polar, w);
    inverse_sums(polar, inverse);
    shear_shares(polar, inverse, share);
    for (int j = 0; j < 3; j++) {
        const OstSimd *v = polar->before + 3 * j;
        OstSimd column[3];
        for (int i = 0; i < 3; i++)
            column[i] = df[3 * i] * v[0] + df[3 * i + 1] * v[1] + df[3 * i + 2] * v[2];
        for (int i = 0; i < 3; i++) {
            const OstSimd *a = polar->after + 3 * i;
            g[i][j] = a[0] * column[0] + a[1] * column[1] + a[2] * column[2];
        }
    }
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0], j = pair[k][1];
        principal[k] = g[k][k];
        principal[3 + k] = share[i][j] * g[i][j] + share[j][i] * g[j][i];
    }
    for (int p = 0; p < STRAINS; p++) {
        change[p] = w[p][0] * principal[0];
        for (int n = 1; n < STRAINS; n++)
            change[p] += w[p][n] * principal[n];
    }
}

/* The stress along the principal directions before. */
static inline void principal_stress(const OstSimd stress[6], OstSimd w[STRAINS][STRAINS], OstSimd s[STRAINS])
{
    for (int a = 0; a < STRAINS; a++) {
        s[a] = w[0][a] * stress[0];
        for (int p = 1; p < STRAINS; p++)
            s[a] += w[p][a] * stress[p];
    }
}

void ost_biot_piola(const OstPolar *polar, const OstSimd stress[6], OstSimd piola[9])
{
    OstSimd w[STRAINS][STRAINS], inverse[3], share[3][3], s[STRAINS];
    OstSimd half[9]; /* rows along the principal directions after */
    principal_to_world(polar, w);
    inverse_sums(polar, inverse);
    shear_shares(polar, inverse, share);
    principal_stress(stress, w, s);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = s[strain_at[i][0]] * share[i][0] * polar->before[j] +
                              s[strain_at[i][1]] * share[i][1] * polar->before[3 + j] +
                              s[strain_at[i][2]] * share[i][2] * polar->before[6 + j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            piola[3 * i + j] =
                polar->after[i] * half[j] + polar->after[3 + i] * half[3 + j] + polar->after[6 + i] * half[6 + j];
}

/* C along the principal directions, w'Cw. */
static inline void principal_elasticity(const OstSimd *c, OstSimd w[STRAINS][STRAINS], OstSimd q[STRAINS][STRAINS])
{
    for (int b = 0; b < STRAINS; b++) {
        OstSimd column[STRAINS], stress[STRAINS];
        for (int p = 0; p < STRAINS; p++)
            column[p] = w[p][b];
        ost_simd_stress(c, column, stress);
        for (int a = 0; a <= b; a++) {
            q[a][b] = w[0][a] * stress[0];
            for (int p = 1; p < STRAINS; p++)
                q[a][b] += w[p][a] * stress[p];
            q[b][a] = q[a][b];
        }
    }
}

/* With Y such that s = UY + YU, Y_ij = s_ij / (sigma_i + sigma_j), and from differentiating UU = F'F twice,
 *     d2W = dU : C : dU + s : d2U = dU : C : dU - 2 Y : dU dU + 2 Y : dF'dF.
 * Along the principal directions, g_ij = a_i'dF v_j, 2 dU_ij = share_ij g_ij + share_ji g_ji. What the diagonal of Y
 * adds is written without a division by sigma_i, which may be 0. */
static inline void principal_hessian(const OstPolar *polar, const OstSimd inverse[3], const OstSimd s[STRAINS],
                                     OstSimd q[STRAINS][STRAINS], OstSimd h[COUNT][COUNT])
{
    OstSimd share[3][3];
    shear_shares(polar, inverse, share);
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0], j = pair[k][1], left = pair[k][2];
        const int terms[3][2] = {{i, 3 + k}, {j, 3 + k}, {strain_at[i][left], strain_at[j][left]}};
        for (int n = 0; n < 3; n++) {
            const OstSimd term = (n < 2 ? 1.0 : 0.5) * s[3 + k] * inverse[k];
            q[terms[n][0]][terms[n][1]] -= term;
            q[terms[n][1]][terms[n][0]] -= term;
        }
    }
    for (int m = 0; m < COUNT; m++)
        for (int n = m; n < COUNT; n++)
            h[m][n] = share[m % 3][m / 3] * share[n % 3][n / 3] * q[strain_at[m % 3][m / 3]][strain_at[n % 3][n / 3]];
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0], j = pair[k][1];
        const OstSimd *sigma = polar->stretch;
        const OstSimd square = inverse[k] * inverse[k];
        h[3 * j + i][3 * j + i] += square * (s[j] * (2.0 * sigma[i] + sigma[j]) - s[i] * sigma[i]);
        h[3 * i + j][3 * i + j] += square * (s[i] * (2.0 * sigma[j] + sigma[i]) - s[j] * sigma[j]);
        h[3 * i + j][3 * j + i] -= square * (s[i] * sigma[j] + s[j] * sigma[i]);
        for (int l = 0; l < 3; l++)
            h[3 * i + l][3 * j + l] += 2.0 * s[3 + k] * inverse[k];
    }
}

/* Have all tets of the batch no negative eigenvalue? Tries Cholesky's factorisation, without roots. */
static inline int are_semidefinite(OstSimd h[COUNT][COUNT])
{
    OstSimd a[COUNT][COUNT], shift = {0};
    memcpy(a, h, sizeof a);
    for (int k = 0; k < COUNT; k++)
        shift += rounding * h[k][k];
    for (int k = 0; k < COUNT; k++) {
        const OstSimd pivot = a[k][k] + shift;
        const OstSimdMask negative = pivot <= 0.0;
        if (ost_simd_any(&negative))
            return 0;
        const OstSimd inverse = 1.0 / pivot;
        for (int i = k + 1; i < COUNT; i++) {
            const OstSimd factor = a[k][i] * inverse;
            for (int j = i; j < COUNT; j++)
                a[i][j] -= factor * a[k][j];
        }
    }
    return 1;
}

/* h minus its negative eigenvalues' part */
static void remove_negative(OstSimd h[COUNT][COUNT])
{
    OstSimd full[COUNT][COUNT], value[COUNT], vectors[COUNT][COUNT];
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < COUNT; j++)
            full[i][j] = i < j ? h[i][j] : h[j][i];
    ost_simd_eigen(COUNT, full[0], value, vectors[0]);
    for (int k = 0; k < COUNT; k++) {
        const OstSimd *v = vectors[k];
        const OstSimdMask negative = value[k] < 0.0;
        const OstSimd excess = OST_SIMD_SELECT(negative, -value[k], (OstSimd){0});
        for (int i = 0; i < COUNT && ost_simd_any(&negative); i++)
            for (int j = i; j < COUNT; j++)
                h[i][j] += excess * v[i] * v[j];
    }
}

/* Block (j, l): from rows and columns along the principal directions after to world axes. */
static inline void turn_block(const OstPolar *polar, OstSimd h[COUNT][COUNT], int j, int l, OstSimd *hessian)
{
    const OstSimd *a = polar->after;
    OstSimd half[9];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            half[3 * i + k] =
                h[3 * j + i][3 * l] * a[k] + h[3 * j + i][3 * l + 1] * a[3 + k] + h[3 * j + i][3 * l + 2] * a[6 + k];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const OstSimd turned = a[i] * half[k] + a[3 + i] * half[3 + k] + a[6 + i] * half[6 + k];
            hessian[COUNT * (3 * j + i) + 3 * l + k] = turned;
            hessian[COUNT * (3 * l + k) + 3 * j + i] = turned;
        }
}

void ost_biot_hessian(const OstPolar *polar, const OstSimd *c, const OstSimd stress[6], int definite,
                      OstSimd hessian[81])
{
    OstSimd w[STRAINS][STRAINS], inverse[3], s[STRAINS], q[STRAINS][STRAINS];
    OstSimd h[COUNT][COUNT]; /* the upper triangle */
    principal_to_world(polar, w);
    inverse_sums(polar, inverse);
    principal_stress(stress, w, s);
    principal_elasticity(c, w, q);
    principal_hessian(polar, inverse, s, q, h);
    if (definite && !are_semidefinite(h))
        remove_negative(h);
    for (int j = 0; j < 3; j++) {
        for (int i = 1; i < 3; i++)
            for (int k = 0; k < i; k++)
                h[3 * j + i][3 * j + k] = h[3 * j + k][3 * j + i];
        for (int l = j; l < 3; l++)
            turn_block(polar, h, j, l, hessian);
    }
}
